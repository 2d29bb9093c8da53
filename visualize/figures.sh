#!/bin/sh
# The figures behind `make figures` and `make check-figures`: figures.sh MODE BIN ALIKE, from the
# top folder. figures.txt lists them with the calls that make them.
#
#   draw    draws every figure into build/figures and takes over those that no longer look like
#           the committed ones
#   check   draws them and fails when one looks different, or is missing; rendered pictures, which
#           take minutes and are compared in the tests, only with FULL=1
#
# ONLY=labs/03 takes the figures whose path begins so. Data is kept in build/figures/data as long
# as neither its program nor a scene that it names is newer.
set -eu

mode=$1
bin=$2
alike=$3
list=visualize/figures.txt
out=build/figures
most=102400 # bytes of a committed figure
faults=0
drawn=0
mkdir -p "$out/data"

# run CALL: a line of the list, its first word a program of ours or a script.
run() {
    case $1 in
    ./*) eval "$1" ;;
    *) eval "$bin/$1" ;;
    esac
}

# fresh FILE CALL: the data is there, and nothing that it comes from is newer.
fresh() {
    [ -e "$1" ] || return 1
    for word in $2; do
        case $word in
        *.xml | ./*) [ "$1" -nt "$word" ] || return 1 ;;
        esac
    done
    [ "$1" -nt "$bin/${2%% *}" ] || [ "${2#./}" != "$2" ]
}

# make_data NAME CALL
make_data() {
    fresh "$out/data/$1" "$2" && return
    echo "- data $1"
    run "$2" >"$out/data/$1.log" || { cat "$out/data/$1.log"; exit 2; }
}

fault() {
    echo "$1" >&2
    faults=$((faults + 1))
}

# make_figure FILE CALL
make_figure() {
    made=$out/$1
    case $mode$2 in checkrender*) [ -n "${FULL:-}" ] || return 0 ;; esac
    mkdir -p "${made%/*}"
    run "$2" >/dev/null
    drawn=$((drawn + 1))
    if [ "$(wc -c <"$made")" -gt $most ]; then
        fault "$1: $(wc -c <"$made") bytes, a figure has at most $most"
    elif [ -e "$1" ] && "$alike" "$1" "$made"; then
        :
    elif [ "$mode" = draw ]; then
        mkdir -p "${1%/*}"
        cp "$made" "$1"
        echo "- $1"
    else
        fault "$1: does not look like what its call draws now ($made); \`make figures\` takes it over"
    fi
}

while IFS='|' read -r first second third _; do
    name=$(echo $first)
    case $name in
    '' | '#'*) continue ;;
    data) name=$(echo $second) call=$third ;;
    *) call=$third ;;
    esac
    call=$(echo "$call" | sed "s#@#$out/data/#g; s#%#$out/$name#g; s/^ *//; s/ *\$//")
    if [ "$(echo $first)" = data ]; then
        # Data is cheap to keep and dear to make: only what is asked for is made.
        [ -z "${ONLY:-}" ] || grep -q "^${ONLY}.*@$name" "$list" || continue
        make_data "$name" "$call"
    else
        case $name in "${ONLY:-}"*) make_figure "$name" "$call" ;; esac
    fi
done <"$list"

echo "$drawn figures drawn, $faults faults"
[ $faults -eq 0 ]
