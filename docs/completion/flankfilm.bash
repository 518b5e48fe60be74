# Completion of flankfilm for bash; it asks the program, so that both always agree. zsh uses it, too,
# after: autoload -Uz bashcompinit && bashcompinit

_flankfilm_models() {
    "$1" models --markdown 2>/dev/null | sed -n 's/^- \[\([^]]*\)\].*/\1/p'
}

# "gears.tip_relief=" for each parameter of the file that the command line names.
_flankfilm_parameters() {
    local word
    for word in "${COMP_WORDS[@]:2}"; do
        [[ $word == *.y*ml ]] || continue
        "$1" explain "$word" 2>/dev/null | awk '
            /^[A-Za-z_0-9-]+: / { stage = substr($1, 1, length($1) - 1); print stage ".use=" }
            /^  [a-z]/ && $1 != "computes:" && $2 != "<-" { print stage "." $1 "=" }'
        return
    done
}

# Words for what stands before the cursor; a stage's "use" wants a model.
_flankfilm() {
    local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} words=
    local before=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        words="$("$program" --help 2>/dev/null | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p') --help --version"
    elif [ "$word" = = ] || [ "$before" = = ]; then
        [ "$word" != = ] || word=
        case ${COMP_WORDS[COMP_CWORD - 1]}${COMP_WORDS[COMP_CWORD - 2]} in
        *.use*) words=$(_flankfilm_models "$program") ;;
        esac
    elif [[ $word == -* ]]; then
        words=$("$program" help "$command" 2>/dev/null | grep -o '^  .*' | grep -o -- '--[a-z][a-z-]*\|^  -[a-z]')
    elif [ "$command" = help ]; then
        words=$("$program" --help 2>/dev/null | sed -n 's/^  \([a-z][a-z]*\) .*/\1/p')
    elif [ "$before" = --set ]; then
        words=$(_flankfilm_parameters "$program")
        compopt -o nospace 2>/dev/null
    elif [ "$before" = --to ]; then
        words="csv $(_flankfilm_models "$program" | sed -n 's|^writer/||p')"
    elif { [ "$command" = report ] || [ "$command" = export ]; } && [[ $before != -* ]]; then
        compopt -o dirnames 2>/dev/null
        return
    elif [ "$before" = --rerun ]; then
        words='failed all'
    elif [ "$command" = models ] && [ "$before" != --plugin-path ]; then
        words=$(_flankfilm_models "$program")
    elif [ "$command" = new ] && [[ $before != -* ]]; then
        words=$(_flankfilm_models "$program" | sed 's|/.*|/|' | sort -u)
        compopt -o nospace
    else
        compopt -o default 2>/dev/null
        return
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -F _flankfilm flankfilm
