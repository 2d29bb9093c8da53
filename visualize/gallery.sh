#!/bin/sh
# The gallery behind `make gallery`: gallery.sh BIN, from the top folder. Renders every scene that
# has a camera twice, quick and good, and lays all pictures on one sheet. Everything lands in
# build/gallery; a picture that is newer than its scene and render is kept.
set -eu

bin=$1
out=build/gallery
size=192x192
mkdir -p "$out"

# picture SCENE NAME OPTIONS: renders $out/NAME.exr with its report.
picture() {
    scene=$1
    made=$out/$2
    shift 2
    [ "$made.exr" -nt "$scene" ] && [ "$made.exr" -nt "$bin/render" ] && return
    echo "- ${made##*/}"
    "$bin/render" "$scene" --size $size "$@" -o "$made.exr" --report "$made.json" >"$made.txt"
}

pictures=
for scene in scenes/*.xml; do
    grep -q '<sensor' "$scene" || continue
    name=${scene##*/}
    name=${name%.xml}
    picture "$scene" "$name.quick" --global-photons 20000 --caustic-photons 20000 -k 50 \
        --gather 0 --spp 1
    picture "$scene" "$name.good" --gather 32
    pictures="$pictures $out/$name.quick.exr $out/$name.good.exr"
done

if [ ! -x "$bin/view" ]; then
    echo "no sheet: VTK is missing; install libvtk9-dev. The pictures are $out/*.exr"
    exit
fi
"$bin/view" contact $pictures -o $out/contact.png --title "Every scene, quick and good"
echo "The sheet of all scenes is $out/contact.png"
