# bash completion for raks: the program itself says what may stand next.

_raks() {
    local word=$2 typed=() i what endings files line

    # Bash takes "--size=1" apart at the sign.
    for ((i = 1; i <= COMP_CWORD; ++i)); do
        if [ $i -gt 1 ] && { [ "${COMP_WORDS[i]}" = = ] || [ "${COMP_WORDS[i - 1]}" = = ]; }; then
            typed[${#typed[@]} - 1]+=${COMP_WORDS[i]}
        else
            typed+=("${COMP_WORDS[i]}")
        fi
    done
    [ "$word" != = ] || word=

    COMPREPLY=()
    {
        read -r what endings
        while IFS=$'\t' read -r line _; do
            [[ "$line" != "$word"* ]] || COMPREPLY+=("$line")
        done
    } < <("$1" --complete "${typed[@]}" 2>/dev/null)

    # Readline quotes what is a file, and a word with a space in it.
    compopt -o filenames
    [ "$what" != words ] || return 0
    mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$word")
    [ "$what" = files ] || return 0
    mapfile -t files < <(compgen -f -- "$word")
    for line in "${files[@]}"; do
        if [ ! -d "$line" ] && { [ -z "$endings" ] || [[ " $endings " == *" .${line##*.} "* ]] ||
            [[ " $endings " == *" .$(tr '[:upper:]' '[:lower:]' <<<"${line##*.}") "* ]]; }; then
            COMPREPLY+=("$line")
        fi
    done
}
complete -F _raks raks raks-train raks-capture
