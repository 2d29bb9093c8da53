#!/usr/bin/env python3
"""Renders our scenes with Mitsuba 3 and writes what it gave, region by region, as JSON.

    pip install mitsuba
    python3 tests/peers/measure.py [--variant scalar_rgb] > tests/peers/mitsuba.json

Runs from the top of the checkout, in some minutes with the variant llvm_ad_rgb (which wants
LLVM 16 or newer), in an hour with scalar_rgb. tests/test_peers.c holds our pictures against
the file; nothing else of the project needs Mitsuba.

A picture of SIDE x SIDE pixels is cut into GRID x GRID regions; a region's value is the mean of
its pixels that count, its error the standard error of that mean over RUNS seeds. In `pixels`
a `.` counts; an `L` sees a lamp, also in part (where all do, in the furnace, they count); an `S`
sees a mirror or glass first, which Mitsuba's particle tracer cannot show.
"""
import argparse
import json
import math
import sys

SIDE = 64
GRID = 4
RUNS = 8
LEAST = 40  # pixels that a region must have

# Path tracing shows all of these scenes. Where the sun shines through water or on a mirror it
# shows no caustic, so that light is traced to the camera instead: all paths whose first surface
# from the camera is diffuse.
# Names of scenes/, or whole paths. In scenes of media, lamps stand in the same medium as what
# they light: Mitsuba 3.9.1 loses a tenth of what an area light sends through a null surface near
# it, also where that bounds no medium (cornell-spheres with an empty null cube in it).
SCENES = {
    "cornell-diffuse": ("path", 512),
    "cornell-spheres": ("path", 2048),
    "cornell-glossy": ("path", 2048),
    "furnace": ("path", 128),
    "integrating-sphere": ("path", 256),
    "lights": ("path", 1024),
    "mesh-spheres": ("path", 256),
    "shell": ("path", 512),
    "square-over-floor": ("path", 256),
    "sparse": ("path", 2048),
    "ring": ("ptracer", 4096),
    "water": ("ptracer", 1024),
    "cornell-fog": ("volpath", 512),
    "sun": ("volpath", 512),
    "tests/peers/nested.xml": ("volpath", 256),
}


def what_is_seen(mi, scene):
    """One letter a pixel: the worst of what 8 x 8 rays through it meet first."""
    fine = 8 * SIDE
    sensor = scene.sensors()[0]
    letters = [["."] * SIDE for _ in range(SIDE)]
    for y in range(fine):
        for x in range(fine):
            at = mi.Point2f((x + 0.5) / fine, (y + 0.5) / fine)
            ray, _ = sensor.sample_ray(0, 0.5, at, mi.Point2f(0.5, 0.5))
            hit = scene.ray_intersect(ray)
            while hit.is_valid() and mi.has_flag(hit.bsdf().flags(), mi.BSDFFlags.Null):
                hit = scene.ray_intersect(hit.spawn_ray(ray.d))
            if not hit.is_valid():
                continue
            row = letters[y // 8]
            if hit.shape.is_emitter():
                row[x // 8] = "L"
            elif mi.has_flag(hit.bsdf().flags(), mi.BSDFFlags.Delta) and row[x // 8] != "L":
                row[x // 8] = "S"
    lamps = sum(row.count("L") for row in letters)
    if lamps == SIDE * SIDE:
        return ["." * SIDE] * SIDE
    return ["".join(row) for row in letters]


def counted(letters, integrator, region):
    """The pixels of a region that count."""
    left_out = "LS" if integrator == "ptracer" else "L"
    step = SIDE // GRID
    top, left = region // GRID * step, region % GRID * step
    return [(y, x) for y in range(top, top + step) for x in range(left, left + step)
            if letters[y][x] not in left_out]


def region_of(pictures, pixels):
    """Mean and its standard error by channel over independent pictures; None: too small."""
    if len(pixels) < LEAST:
        return None
    rows, columns = zip(*pixels)
    runs = [picture[list(rows), list(columns), :3].mean(axis=0) for picture in pictures]
    mean = [math.fsum(run[c] for run in runs) / RUNS for c in range(3)]
    square = [math.fsum((run[c] - mean[c]) ** 2 for run in runs) for c in range(3)]
    error = [math.sqrt(square[c] / (RUNS - 1) / RUNS) for c in range(3)]
    return {"mean": [float(f"{m:.6g}") for m in mean],
            "error": [float(f"{e:.3g}") for e in error]}


def measure(mi, variant, name):
    """All about one scene."""
    integrator, spp = SCENES[name]
    size = {"width": str(SIDE), "height": str(SIDE)}
    path = name if name.endswith(".xml") else f"scenes/{name}.xml"
    mi.set_variant("scalar_rgb")
    letters = what_is_seen(mi, mi.load_file(path, **size))
    mi.set_variant(variant)
    scene = mi.load_file(path, **size)
    how = mi.load_dict({"type": integrator, "max_depth": -1, "rr_depth": 8})
    import numpy
    pictures = [numpy.array(mi.render(scene, integrator=how, spp=spp, seed=1000 + run),
                            dtype=numpy.float64) for run in range(RUNS)]
    regions = [region_of(pictures, counted(letters, integrator, r))
               for r in range(GRID * GRID)]
    return {"scene": path, "renderer": f"Mitsuba {mi.__version__}, {variant}",
            "integrator": integrator, "spp": spp, "runs": RUNS, "pixels": letters,
            "regions": regions}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--variant", default="scalar_rgb")
    parser.add_argument("scenes", nargs="*", default=list(SCENES))
    asked = parser.parse_args()
    import mitsuba as mi
    results = []
    for name in asked.scenes:
        print(name, file=sys.stderr)
        results.append(measure(mi, asked.variant, name))
    answer = {"command": "python3 tests/peers/measure.py --variant " + asked.variant,
              "side": SIDE, "grid": GRID, "scenes": results}
    json.dump(answer, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
