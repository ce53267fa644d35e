# Completion of rugosa for bash: subcommands and flags as the program's own help lists them.
# Installed where bash-completion looks; or type: source completion.bash

_rugosa_words() { # the words of a help page that stand where subcommands or flags do
    "$@" --help 2>/dev/null | sed -n 's/^  \(--[a-zA-Z][a-zA-Z-]*\).*/\1/p; s/^  \([a-z][a-z-]*\)  .*/\1/p'
}

_rugosa_variants() { # of rugosa design, as the list of operators has them
    "$1" operators 2>/dev/null | sed -n '/^variants$/,/^$/s/^  \([a-z0-9-]*\) = .*/\1/p'
}

_rugosa_choices() { # the words that a flag takes, as the help page lists them
    local flag=$1
    shift
    "$@" --help 2>/dev/null | tr -s ' \n' ' ' | sed -n "s/.* $flag X \([^[]*\).*/\1/p" | sed 's/ --.*//' | sed -n 's/.*; one of //p' | tr -d ,
}

_rugosa() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
    local command=("${COMP_WORDS[0]}") word
    for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        case $word in
        -*) break ;;
        *) _rugosa_words "${command[@]}" | grep -qxe "$word" && command+=("$word") || break ;;
        esac
    done
    COMPREPLY=()
    case $previous in
    --*)
        word=$(_rugosa_choices "$previous" "${command[@]}")
        [[ -z $word && $previous == --variant ]] && word=$(_rugosa_variants "${COMP_WORDS[0]}")
        COMPREPLY=($(compgen -W "$word" -- "$current"))
        ;;
    esac
    [ ${#COMPREPLY[@]} -gt 0 ] && return
    if [[ $current == -* ]]; then
        COMPREPLY=($(compgen -W "$(_rugosa_words "${command[@]}" | grep '^--') --help --quiet --verbose" -- "$current"))
    elif [[ $previous != -* ]]; then
        COMPREPLY=($(compgen -W "$(_rugosa_words "${command[@]}" | grep -v '^--')" -- "$current"))
    fi
    [ ${#COMPREPLY[@]} -gt 0 ] || COMPREPLY=($(compgen -f -- "$current"))
}
complete -o filenames -F _rugosa rugosa
