#!/bin/sh
# The gallery behind `make gallery`: gallery.sh BIN, from the top folder. Everything lands in
# build/gallery; a picture that is newer than its scene and its program is kept.
#
# From the environment: ONLY, one of
#   scenes   every scene that has a camera, quick and good, on contact.png
#   lecture  the lecture's pictures, on lecture.png: first one box whose light is built up step by
#            step, then a picture of each effect
#   beside   one scene (SCENE, cornell-fog by default) by photons and by path tracing, on
#            beside-SCENE.png
# or nothing for the first two.
set -eu

bin=$1
out=build/gallery
size=192x192
mkdir -p "$out"

# picture PROGRAM SCENE NAME OPTIONS: makes $out/NAME.exr with its report, and adds it to the
# sheet.
picture() {
    program=$bin/$1
    scene=scenes/$2.xml
    made=$out/$3
    shift 3
    sheet="$sheet $made.exr"
    [ "$made.exr" -nt "$scene" ] && [ "$made.exr" -nt "$program" ] && return
    echo "- ${made##*/}"
    "$program" "$scene" --size $size "$@" -o "$made.exr" --report "$made.json" >"$made.txt"
}

# lay NAME TITLE WHAT: all pictures since the last sheet on $out/NAME.png.
lay() {
    if [ ! -x "$bin/view" ]; then
        echo "no sheet: VTK is missing; install libvtk9-dev. The pictures are $out/*.exr"
        sheet=
        return
    fi
    "$bin/view" contact $sheet -o "$out/$1.png" --title "$2"
    echo "$3 is $out/$1.png"
    sheet=
}

scenes() {
    for file in scenes/*.xml; do
        grep -q '<sensor' "$file" || continue
        name=${file##*/}
        name=${name%.xml}
        picture render "$name" "$name.quick" --global-photons 20000 --caustic-photons 20000 \
            --volume-photons 10000 -k 50 --gather 0 --spp 1
        picture render "$name" "$name.good" --gather 32
    done
    lay contact "Every scene, quick and good" "The sheet of all scenes"
}

# One box: the same command five times, each with one thing more.
build_up() {
    bulb="-D radiance=0 -D bulb=0.513,0.363,0.222"
    good="--gather 32 --spp 8"
    picture render lecture one-box.1-hard-shadows $good $bulb --global-photons 0 \
        --caustic-photons 0
    picture render lecture one-box.2-soft-shadows $good --global-photons 0 \
        --caustic-photons 0
    picture render lecture one-box.3-caustics $good --global-photons 0
    picture render lecture one-box.4-indirect-light $good
    picture render lecture one-box.5-a-medium $good -D density=0.6
}

lecture() {
    build_up
    good="--gather 32"
    picture render mesh-spheres directional-light.mesh-spheres $good
    picture render square-over-floor square-light.square-over-floor $good
    picture render lecture point-light.lecture $good -D radiance=0 -D bulb=0.513,0.363,0.222
    picture render lights several-lights.lights $good
    picture render cornell-diffuse Cornell-box.direct-light $good --only direct
    picture render cornell-diffuse Cornell-box.indirect-light $good --only indirect
    picture render cornell-diffuse Cornell-box.both $good
    picture render cornell-glossy glossy-reflection.cornell-glossy $good
    picture render sparse projection-map.off $good --projection off
    picture render sparse projection-map.on $good
    picture render ring metal-ring.ring $good
    picture render water caustics.water $good
    picture render sun shafts-of-light.sun $good
    picture render glass-fog caustic-in-fog.glass-fog $good --volume-photons 1000000
    picture render prism prism.prism $good --caustic-photons 1000000 -r 0.02
    picture render cornell-fog a-medium.photons $good
    picture reference cornell-fog a-medium.path-tracing --spp 64
    lay lecture "The lecture's pictures" "The sheet of the lecture"
}

beside() {
    name=${SCENE:-cornell-fog}
    picture render "$name" "$name.photons"
    picture reference "$name" "$name.path-tracing" --spp 128
    lay "beside-$name" "Photons beside path tracing" "The sheet"
}

sheet=
case ${ONLY:-} in
'') scenes && lecture ;;
scenes | lecture | beside) $ONLY ;;
*)
    echo "gallery: ONLY must be scenes, lecture or beside, got \"$ONLY\"" >&2
    exit 2
    ;;
esac
