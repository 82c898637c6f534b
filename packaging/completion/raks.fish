# fish completion for raks: the program itself says what may stand next.

function __raks_complete
    set -l typed (commandline --current-process --tokenize --cut-at-cursor)
    set -l word (commandline --current-token --cut-at-cursor)
    set -l lines ($typed[1] --complete $typed[2..-1] "$word" 2>/dev/null)
    set -l endings (string split ' ' -- $lines[1])
    set -l option (string match --regex -- '^--[^=]*=' "$word")
    for line in $lines[2..-1]
        echo "$option$line"
    end
    switch "$endings[1]"
        case folders
            __fish_complete_directories (string replace -- "$option" '' "$word") ''
        case files
            if set -q endings[2]
                __fish_complete_directories "$word" ''
                for ending in $endings[2..-1]
                    complete --do-complete "__raks_any $word" | string match --ignore-case --regex ".*\\$ending\$"
                end
            else
                complete --do-complete "__raks_any $word"
            end
    end
end

complete --command raks --no-files --arguments '(__raks_complete)'
complete --command raks-train --no-files --arguments '(__raks_complete)'
complete --command raks-capture --no-files --arguments '(__raks_complete)'
