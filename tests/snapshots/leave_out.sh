#!/bin/sh
# leave_out.sh IN OUT FIRST LAST: a copy of a BIIP log without some of its records (docs/formats/biip.md), as
# a run would have left it that never went there.
set -eu
number() { od -A n -t u"$2" -j "$1" -N "$2" "$in" | tr -d ' '; }
in=$1
header=$(number 12 4)
record=$(number 16 4)
count=$(($(number 24 8) - $4 + $3 - 1))
{
  head -c 24 "$in"
  for shift in 0 8 16 24 32 40 48 56; do printf "\\$(printf %o $((count >> shift & 255)))"; done
  head -c $((header + record * $3)) "$in" | tail -c +33
  tail -c +$((header + record * ($4 + 1) + 1)) "$in"
} >"$2"
