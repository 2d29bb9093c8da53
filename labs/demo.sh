#!/bin/sh
# The demonstration behind `make demo`: demo.sh BIN, from the top folder. Renders the Cornell box
# with a mirror and a glass sphere, and pictures its photons, their paths, the tree over them,
# irradiance, kernels and layers. Everything lands in build/demo.
set -eu

bin=$1
scene=scenes/cornell-spheres.xml
out=build/demo
photons="--global-photons 200000 --caustic-photons 100000"
mkdir -p "$out"

step() {
    echo "- $*"
}

step "render $scene: 512x512, 200000 + 100000 photons, gather 16"
"$bin/render" $scene --size 512x512 --spp 1 --gather 16 $photons \
    -o $out/cornell-spheres.exr --png $out/cornell-spheres.png \
    --report $out/cornell-spheres.json >$out/stages.txt

step "store the photon maps"
"$bin/storage" $scene $photons -o $out/photons.ply --report $out/storage.json >$out/storage.txt

step "balance the global map"
"$bin/balancing" $scene -n 200000 -o $out/tree.ply --report $out/tree.json >$out/tree.txt

step "emit photons, and trace paths"
"$bin/emission" $scene -n 2000 --dump $out/rays.csv >$out/emission.txt
"$bin/tracing" $scene -n 2000 --dump $out/paths.csv >$out/tracing.txt

step "estimate the irradiance of the floor, with the photons of one estimate and the kernels"
"$bin/radiance" $scene -n 200000 -k 100 --on floor --grid 128x128 --dump $out/floor.csv \
    >$out/floor.txt
"$bin/radiance" $scene -n 50000 -k 150 --at -0.475,0,0.15 --normal 0,1,0 \
    --gathered $out/gathered.csv >$out/gathered.txt
"$bin/filtering" $scene -n 20000 --at 0,0,0.1 --normal 0,1,0 --curves $out/kernels.csv \
    >$out/kernels.txt

if [ -x "$bin/view" ]; then
    step "draw every stage"
    "$bin/view" directions $out/rays.csv --scene $scene -o $out/directions.png
    "$bin/view" photons $out/photons.ply $out/photons.caustic.ply --scene $scene \
        -o $out/photons.png
    "$bin/view" paths $out/paths.csv --scene $scene -o $out/paths.png
    "$bin/view" tree $out/tree.ply --scene $scene -o $out/tree.png
    "$bin/view" irradiance $out/floor.csv --scene $scene -o $out/irradiance.png
    "$bin/view" gather $out/gathered.csv --scene $scene -o $out/gather.png
    "$bin/view" kernels $out/kernels.csv -o $out/kernels.png
    "$bin/view" layers $out/cornell-spheres.exr -o $out/layers.png
    drawn="
  directions of emission   $out/directions.png
  photon positions         $out/photons.png
  photon paths             $out/paths.png
  kd-tree splits by depth  $out/tree.png
  irradiance on the floor  $out/irradiance.png
  photons of one estimate  $out/gather.png
  kernels                  $out/kernels.png
  layers of the picture    $out/layers.png"
else
    drawn="
  no pictures of photons: VTK is missing; install libvtk9-dev"
fi

cat <<END

Pictures
  the scene, all layers    $out/cornell-spheres.exr
  the scene, for a screen  $out/cornell-spheres.png$drawn

END
cat $out/stages.txt
