#!/usr/bin/env zsh
# Types into a real zsh with the generated completion and compares what it makes of Tab.
#
# usage: completion_test.zsh FOLDER_OF_COMPLETION
emulate -L zsh
zmodload zsh/zpty
integer failures=0

# Reads what the shell writes until it holds a text; into `said`.
listen_for() {
    local piece
    integer k
    said=""
    for ((k = 0; k < 100; ++k)); do
        while zpty -r -t shell piece; do said+=$piece; done
        [[ $said == *$1* ]] && return 0
        sleep 0.05
    done
    return 1
}

# completes TYPED EXPECTED: what stands on the line after Tab holds EXPECTED.
completes() {
    local said
    zpty shell "TERM=vt100 zsh -f -i"
    zpty -w shell "PS1='> '; fpath=(${(q)folder} \$fpath); autoload -Uz compinit; compinit -u -D; print RE''ADY"
    listen_for READY
    zpty -w -n shell "$1"$'\t'
    listen_for "$2" || { print -r -- "'$1': no '$2' in: ${(V)said}"; failures=1 }
    zpty -d shell
}

folder=$1
completes 'clsurf rend' 'er'  # behind what was typed
completes 'clsurf render --vi' '--view'
completes 'clsurf render --view to' 'top'
completes 'clsurf render --colormap vi' 'viridis'
completes 'clsurf moves --dialect linu' 'linuxcnc'
completes 'clsurf help dial' 'dialects'
exit $failures
