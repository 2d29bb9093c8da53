"""Values of bsdfs as Mitsuba 3 has them, for tests/test_material_peer.c.

    pip install mitsuba
    python3 tests/peers/materials.py > tests/peers/materials.txt

A line `bsdf XML` is followed by lines `wi.x wi.y wi.z wo.x wo.y wo.z r g b`: value times the
cosine of wo, without smooth lobes. A line `smooth cos reflected through` has what a smooth one
does at a cosine instead.
"""

import math

import mitsuba as mi

mi.set_variant("scalar_rgb")

ROUGH = [
    "<bsdf type='roughconductor'/>",
    "<bsdf type='roughconductor'><string name='distribution' value='ggx'/>"
    "<float name='alpha' value='0.3'/></bsdf>",
    "<bsdf type='roughconductor'><string name='distribution' value='ggx'/>"
    "<float name='alpha' value='1'/><rgb name='eta' value='0.2 0.9 1.1'/>"
    "<rgb name='k' value='3.9 2.4 2.2'/><float name='specular_reflectance' value='0.8'/></bsdf>",
    "<bsdf type='roughconductor'><float name='alpha' value='0.6'/>"
    "<rgb name='eta' value='0.2 0.9 1.1'/><rgb name='k' value='3.9 2.4 2.2'/></bsdf>",
    "<bsdf type='plastic'/>",
    "<bsdf type='plastic'><rgb name='diffuse_reflectance' value='0.9 0.4 0.1'/>"
    "<float name='int_ior' value='1.9'/></bsdf>",
    "<bsdf type='roughplastic'/>",
    "<bsdf type='roughplastic'><rgb name='diffuse_reflectance' value='0.9 0.4 0.1'/>"
    "<string name='distribution' value='ggx'/><float name='alpha' value='0.4'/></bsdf>",
    "<bsdf type='roughplastic'><float name='alpha' value='0.8'/>"
    "<string name='int_ior' value='diamond'/>"
    "<float name='specular_reflectance' value='0.5'/></bsdf>",
]
SMOOTH = ["<bsdf type='thindielectric'/>", "<bsdf type='dielectric'/>"]


def load(xml):
    return mi.load_string(xml.replace("<bsdf ", "<bsdf version='3.0.0' ", 1))


def direction(cosine, turn):
    sine = math.sqrt(1.0 - cosine * cosine)
    return mi.Vector3f(sine * math.cos(turn), sine * math.sin(turn), cosine)


def hit(wi):
    si = mi.SurfaceInteraction3f()
    si.wi = wi
    return si


def show(numbers):
    print(" ".join(f"{x:.9g}" for x in numbers))


for xml in ROUGH:
    bsdf = load(xml)
    print("bsdf", xml)
    for wi, wo in [((0.98, 0.4), (0.9, 3.0)), ((0.7, 0.4), (0.68, 3.5)), ((0.4, 0.4), (0.8, 1.2)),
                   ((0.3, 0.4), (0.3, 3.7)), ((0.15, 0.4), (0.6, 5.0)), ((0.05, 0.4), (0.1, 3.5))]:
        a, b = direction(*wi), direction(*wo)
        show([*a, *b, *bsdf.eval(mi.BSDFContext(), hit(a), b)])
for xml in SMOOTH:
    bsdf = load(xml)
    print("bsdf", xml)
    for cosine in (1.0, 0.7, 0.3, 0.1, 0.01):
        reflected = [0.0, 0.0]
        for first in (0.0, 1.0 - 1e-7):  # the first random number picks the lobe
            sample, _ = bsdf.sample(mi.BSDFContext(), hit(direction(cosine, 0.4)), first,
                                    mi.Point2f(0.5))
            reflected[sample.wo.z < 0.0] = sample.pdf
        print("smooth", f"{cosine:g} {reflected[0]:.9g} {reflected[1]:.9g}")
