#!/usr/bin/env fish
# Asks a real fish what it offers with the generated completion.
#
# usage: completion_test.fish COMPLETION_FILE
source $argv[1]
set failures 0
# offers EXPECTED TYPED: EXPECTED is among what fish offers after TYPED.
function offers
    if not complete -C "$argv[2]" | string split -f1 \t | string match -q -- $argv[1]
        echo "'$argv[2]': '$argv[1]' is not offered, but: "(complete -C "$argv[2]")
        set -g failures 1
    end
end
cd (mktemp -d)
touch part.nc
offers render 'clsurf ren'
offers --view 'clsurf render --vi'
offers top 'clsurf render a b --view t'
offers viridis 'clsurf render --colormap v'
offers always 'clsurf moves --progress al'
offers linuxcnc 'clsurf moves --dialect li'
offers part.nc 'clsurf moves pa'
offers part.nc 'clsurf render -o pa'
offers dialects 'clsurf help dia'
exit $failures
