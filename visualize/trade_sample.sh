#!/bin/sh
# A small measured trade of speed for accuracy: trade_sample.sh BIN OUT.json [SCENE], from the
# top folder. Renders the scene (cornell-diffuse) with some settings and three seeds each,
# compares with a path-traced reference, and writes what `view trade` draws; under a minute. One
# thread renders, so that other work on the machine disturbs the times less.
#
# Bias and variance from pictures alone: two runs that differ by their seed only differ by twice
# the variance; what the error has beyond the variance is bias^2.
set -eu

bin=$1
out=$2
scene=${3:-scenes/cornell-diffuse.xml}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
size=40x40

# top FILE KEY: a number at the top of a report.
top() {
    sed -n "s/^  \"$2\": \([-0-9.e+]*\),\{0,1\}\$/\1/p" "$1"
}

seconds() {
    sed -n '/^  "seconds": {/,/^  }/s/^    "total": \([0-9.e+-]*\).*/\1/p' "$1"
}

rel_mse() {
    "$bin/compare" "$1" "$2" --report "$work/compare.json" >"$work/compare.txt"
    top "$work/compare.json" rel_mse
}

# measure PHOTONS K GATHER: a line "photons k gather seconds*3 rel_mse*3 pair*3 peak".
measure() {
    times=
    errors=
    for seed in 1 2 3; do
        "$bin/render" "$scene" --size $size --global-photons "$1" -k "$2" --gather "$3" --spp 4 \
            --threads 1 --seed $seed -o "$work/$seed.exr" --report "$work/$seed.json" \
            >"$work/render.txt"
        times="$times $(seconds "$work/$seed.json")"
        errors="$errors $(rel_mse "$work/$seed.exr" "$work/reference.exr")"
    done
    pairs="$(rel_mse "$work/1.exr" "$work/2.exr") $(rel_mse "$work/2.exr" "$work/3.exr")"
    pairs="$pairs $(rel_mse "$work/3.exr" "$work/1.exr")"
    echo "$1 $2 $3 $times $errors $pairs $(top "$work/1.json" peak_bytes)"
}

# Lines of measure() to JSON. A setting is on the Pareto line when no other is both faster and
# better; the slope is a least-squares one of log rel_rmse over log seconds along that line.
to_json() {
    awk -v scene="$scene" '
        function mean(a, b, c) { return (a + b + c) / 3 }
        function sd(a, b, c, m) {
            m = mean(a, b, c)
            return sqrt(((a - m) ^ 2 + (b - m) ^ 2 + (c - m) ^ 2) / 2)
        }
        NF != 13 {
            print "trade_sample: a report has no seconds or no rel_mse: " $0 >"/dev/stderr"
            failed = 1
            exit
        }
        {
            n = NR - 1
            time[n] = mean($4, $5, $6)
            error[n] = mean($7, $8, $9)
            variance = mean($10, $11, $12) / 2
            bias = error[n] > variance ? sqrt(error[n] - variance) : 0
            line[n] = sprintf("{\"settings\": {\"photons\": %d, \"k\": %d, \"gather\": %d}, " \
                "\"seconds\": {\"mean\": %.6g, \"sd\": %.6g}, " \
                "\"rel_mse\": {\"mean\": %.6g, \"sd\": %.6g}, " \
                "\"bias\": %.6g, \"variance\": %.6g, \"peak_bytes\": %d}", $1, $2, $3,
                time[n], sd($4, $5, $6), error[n], sd($7, $8, $9), bias, variance, $13)
        }
        END {
            if (failed) {
                exit 2
            }
            printf "{\"scene\": \"%s\",\n\"points\": [\n", scene
            for (i = 0; i < NR; i++) {
                printf "%s%s\n", line[i], i < NR - 1 ? "," : "],"
                beaten = 0
                for (j = 0; j < NR; j++) {
                    beaten += time[j] < time[i] && error[j] < error[i]
                }
                if (!beaten) {
                    pareto = pareto (pareto == "" ? "" : ", ") i
                    x = log(time[i])
                    y = log(error[i]) / 2
                    count++
                    sx += x; sy += y; sxx += x * x; sxy += x * y
                }
            }
            spread = count * sxx - sx * sx
            slope = spread > 0 ? sprintf("%.4g", (count * sxy - sx * sy) / spread) : "null"
            printf "\"pareto\": [%s],\n\"slope\": %s}\n", pareto, slope
        }' "$1"
}

"$bin/reference" "$scene" --size $size --spp 512 -o "$work/reference.exr" >"$work/reference.txt"
while read -r photons k gather; do
    measure "$photons" "$k" "$gather"
done >"$work/lines" <<END
2000 50 0
10000 50 0
10000 200 0
50000 50 0
50000 200 0
200000 100 0
200000 400 0
10000 50 16
10000 50 64
50000 100 64
200000 100 64
END
to_json "$work/lines" >"$work/trade.json"
mv "$work/trade.json" "$out"
