#!/usr/bin/env bash
# Completion in real shells: what stands on their command line when somebody has typed so far and pressed Tab.
#   tests/scripts/completion_test.sh BUILD_FOLDER
# Exit code 77: skipped, as the program was not built.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
scripts=$here/../../packaging/completion
real=$1/bin/raks
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
[ -x "$real" ] || { echo "skipped: raks was not built"; exit 77; }

# What is installed is what the program prints.
for pair in bash:raks.bash zsh:_raks fish:raks.fish; do
    "$real" completion "${pair%%:*}" | cmp - "$scripts/${pair#*:}" || failures=1
done

# A folder with files, and a sound server with a loudspeaker, whose name has spaces, in place of this
# computer's.
mkdir "$work/bin" "$work/files" "$work/files/album"
touch "$work/files/"{song.mp3,song.txt,"my song.flac",me.vrm,me.txt,LOUD.WAV,LOUD.DOC}
cat >"$work/bin/raks" <<RAKS
#!/bin/sh
if [ "\$1 \$2 \$3" = "--complete play --output" ]; then
    printf 'words\nLiving Room\tPulseAudio\nHDMI\tALSA\n'
else
    exec "$real" "\$@"
fi
RAKS
chmod +x "$work/bin/raks"
export PATH=$work/bin:$PATH HOME=$work TERM=xterm XDG_DATA_HOME=$work/share
export XDG_CONFIG_HOME=$work/config

# Each line: what is typed, then what stands there after Tab; the last column holds for zsh where it differs.
cat >"$work/cases" <<'CASES'
raks pla|raks play 
raks play --shuf|raks play --shuffle 
raks play --dance wal|raks play --dance waltz 
raks play --avatar mann|raks play --avatar mannequin 
raks play --output Liv|raks play --output Living\ Room 
raks play --theme=work|raks play --theme=workshop_dark 
raks play so|raks play song.mp3 
raks play my|raks play my\ song.flac 
raks play LO|raks play LOUD.WAV 
raks play al|raks play album/
raks play song.mp3 my|raks play song.mp3 my\ song.flac 
raks xbody me|raks xbody me.vrm 
raks stick --align rig|raks stick --align rigid 
raks avatar ex|raks avatar export 
raks train fig|raks train figure 
raks completion z|raks completion zsh 
CASES
if [ -x "$1/bin/raks-train" ]; then
    ln -s "$(realpath "$1/bin/raks-train")" "$work/bin/raks-train"
    echo 'raks train figure --prop|raks train figure --propose ' >>"$work/cases"
    echo 'raks-train figure --prop|raks-train figure --propose ' >>"$work/cases"
fi

# Control-G writes the line into a file, control-U empties it.
cat >"$work/bash.rc" <<RC
. "$scripts/raks.bash"
bind 'set bell-style none'
bind 'set enable-bracketed-paste off'
note() { printf '%s\n' "\$READLINE_LINE" >>"$work/bash.lines"; echo noted; }
bind -x '"\C-g": note'
cd "$work/files"
PS1='ready> '
RC
cat >"$work/zsh.rc" <<RC
fpath=("$scripts" \$fpath)
autoload -Uz compinit && compinit -u -d "$work/dump"
note() { print -r -- "\$BUFFER" >>"$work/zsh.lines"; print noted; }
zle -N note
bindkey -e
bindkey '^G' note
unsetopt beep zle_bracketed_paste
cd "$work/files"
PS1='ready> '
RC
sed 's/^fpath=.*//; s/zsh.lines/evaluated.lines/; s|^PS1|eval "$(raks completion zsh)"; PS1|' \
    "$work/zsh.rc" >"$work/evaluated.rc"

# completes SHELL COMMAND...: what stands there is what was wanted.
completes() {
    local shell=$1
    shift
    timeout 60 zsh -f "$here/type_into.zsh" "$work/$shell.rc" "$work/cases" "$@" ||
        { echo "FAILED: $shell does not go on" >&2; failures=1; }
    if ! diff <(cut -d '|' -f 2 "$work/cases") "$work/$shell.lines" >"$work/diff" 2>&1; then
        echo "FAILED: $shell completes otherwise (< wanted, > stands there):" >&2
        cat "$work/diff" >&2
        failures=1
    fi
}
if command -v zsh >/dev/null; then
    completes bash bash --norc --noprofile -i
    completes zsh zsh -f -i
    completes evaluated zsh -f -i
else
    echo "skipped: zsh, which types into terminals, is not here"
fi

# Fish says what it would put in place of the last word.
if command -v fish >/dev/null; then
    cd "$work/files"
    while IFS='|' read -r typed wanted; do
        wanted=${wanted#"${typed% *} "}
        wanted=${wanted% } wanted=${wanted//\\ / }
        offered=$(fish --no-config -c "source '$scripts/raks.fish'; complete --do-complete '$typed'" | cut -f 1)
        [ "$offered" = "$wanted" ] || {
            echo "FAILED: fish: $typed: offers \"$offered\" and not \"$wanted\"" >&2
            failures=1
        }
    done <"$work/cases"
else
    echo "skipped: fish is not here"
fi
exit $failures
