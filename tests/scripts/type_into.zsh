# Types into a shell on a terminal of its own, line by line, and presses Tab behind each.
#   zsh -f type_into.zsh RC CASES COMMAND...
# RC: what the shell reads first; it sets the prompt "ready> ", and binds control-G to what notes the line
# and prints "noted". CASES: each line up to its bar is typed.
zmodload zsh/zpty
rc=$1 cases=$2
shift 2
zpty shell "$@"
zpty -w -n shell ". $rc"$'\n'
zpty -r shell screen '*ready> *'
while IFS='|' read -r typed wanted; do
    zpty -w -n shell "$typed"$'\t\a'
    zpty -r shell screen '*noted*'
    zpty -w -n shell $'\025'
done <$cases
zpty -d shell
