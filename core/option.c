// The table of all options. Its order is the order of --help.
#include "option.h"

#include <math.h>

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define AT(field) offsetof(pm_options, field)
#define MANY 9007199254740992.0 // 2^53: counts stay exact where they meet doubles
#define UINT32_ABOVE 4294967295.0
#define PASSES_MOST 268435455.0 // 2^28 - 1: what random numbers tell apart (rng.h)
#define REACH_LEAST 1e-30       // [m] the last pass's is a float above 0, and has a square

static const pm_option table[] = {
    {"n", "n", PM_OPTION_COUNT, AT(photons), 0, 1, MANY, "N",
     "photons emitted for each map that is traced", "200000"},
    {"photons", "photons", PM_OPTION_COUNT, AT(photons_total), 0, 1, MANY, "N",
     "photons emitted in all, split 2:2:1 among those of the global, caustic and volume map "
     "that the picture needs",
     "none: the numbers of each map"},
    {"global-photons", "global-photons", PM_OPTION_COUNT, AT(photons[PM_MAP_GLOBAL]), 0, 0,
     MANY, "N", "photons emitted for the global map; 0: no such map", NULL},
    {"caustic-photons", "caustic-photons", PM_OPTION_COUNT, AT(photons[PM_MAP_CAUSTIC]), 0, 0,
     MANY, "N", "photons emitted for the caustic map; 0: no such map", NULL},
    {"volume-photons", "volume-photons", PM_OPTION_COUNT, AT(photons[PM_MAP_VOLUME]), 0, 0,
     MANY, "N", "photons emitted for the volume map; 0: no such map", NULL},
    {"roulette", "roulette", PM_OPTION_CHOICE, AT(roulette), 0, 0, 0, "max|average",
     "how the chance to go on is taken from the colours", NULL},
    {"max-bounces", "max-bounces", PM_OPTION_COUNT32, AT(max_bounces), 0, 1, UINT32_ABOVE, "N",
     "events after which a path is cut (its power is reported as lost)",
     "none; 10000 where an albedo is above 0.9999"},
    {"packing", "packing", PM_OPTION_SWITCH, AT(unpacked), 0, 0, 0, "on|off",
     "20-byte photons; off keeps exact power and direction beside them", NULL},
    {"k", "k", PM_OPTION_COUNT32, AT(estimate.k), AT(k_given), 1, PM_MAP_MAX, "N",
     "photons of an estimate", NULL},
    {"r", "r", PM_OPTION_POSITIVE, AT(estimate.radius), 0, REACH_LEAST, (double)INFINITY, "R",
     "reach of an estimate [m], or none", "none"},
    {"shape", "shape", PM_OPTION_CHOICE, AT(estimate.shape), 0, 0, 0, "disc|sphere",
     "region of an estimate", NULL},
    {"flatness", "flatness", PM_OPTION_POSITIVE, AT(estimate.flatness), 0, 0, 1, "F",
     "height of the disc over its radius, above 0, at most 1", NULL},
    {"filter", "filter", PM_OPTION_CHOICE, AT(estimate.filter), 0, 0, 0,
     "none|cone|gaussian|epanechnikov", "kernel of an estimate", NULL},
    {"kernel-constants", "kernel-constants", PM_OPTION_CHOICE, AT(estimate.constants), 0, 0, 0,
     "unbiased|lecture", "lecture: 0.918 in the Gaussian, and k photons in place of k - 1",
     NULL},
    {"gather", "gather", PM_OPTION_COUNT32, AT(gather), AT(gather_given), 0, 1e6, "N",
     "directions of a final gather; 0: the global map is seen directly", NULL},
    {"spp", "spp", PM_OPTION_COUNT32, AT(spp), AT(spp_given), 1, 1e6, "N", "samples of a pixel",
     NULL},
    {"direct", "direct", PM_OPTION_SWITCH, AT(direct_photons), 0, 0, 0, "rays|photons",
     "direct light by shadow rays alone, or by shadow photons (as many as the global map has, "
     "sent besides) and rays where these differ",
     NULL},
    {"caustics", "caustics", PM_OPTION_SWITCH, AT(caustics_global), 0, 0, 0, "map|global",
     "caustics from a map of their own, or from the global map", NULL},
    {"precompute", "precompute", PM_OPTION_SWITCH, AT(precompute), 0, 0, 0, "off|on",
     "irradiance at photon positions, for gather rays to look up", NULL},
    {"projection", "projection", PM_OPTION_SWITCH, AT(everywhere), 0, 0, 0, "on|off",
     "photons are sent where they count, or everywhere", NULL},
    {"media", "media", PM_OPTION_SWITCH, AT(media_march), 0, 0, 0, "beams|march",
     "how the volume map is asked: once for a whole ray, or step by step", NULL},
    {"march-step", "march-step", PM_OPTION_POSITIVE, AT(march_step), 0, 0, 1e30, "M",
     "step of --media march [m], above 0",
     "half a mean free path, at most a fortieth of the photons' box"},
    {"progressive", "progressive", PM_OPTION_FLAG, AT(progressive), 0, 0, 0, "",
     "the mean of many passes with new photons and ever smaller radii; unless told, a pass has "
     "--spp 1 and --gather 0",
     NULL},
    {"passes", "passes", PM_OPTION_COUNT32, AT(passes), 0, 1, PASSES_MOST, "N",
     "passes of --progressive", NULL},
    {"checkpoint", "checkpoint", PM_OPTION_TEXT, AT(checkpoint), 0, 0, 0, "FILE",
     "keeps what the passes so far came to, so that --resume can go on from it", "none"},
    {"resume", "resume", PM_OPTION_FLAG, AT(resume), 0, 0, 0, "",
     "go on where the file of --checkpoint was left", NULL},
    {"light-paths", "light-paths", PM_OPTION_COUNT, AT(light_paths), 0, 0, MANY, "N",
     "paths from lights of no extent to the camera, for what eye paths cannot find", NULL},
    {"view", "view", PM_OPTION_SWITCH, AT(view_photons), 0, 0, 0, "full|photons",
     "the picture, or its photons as dots (--exposure -2 shows their colours)", NULL},
    {"size", "size", PM_OPTION_SIZE, AT(width), 0, 1, 65536, "WxH", "pixels",
     "the scene's; 1200x900 of figures"},
    {"preset", "preset", PM_OPTION_WORD, AT(preset), 0, 0, 0,
     "lecture-10k|lecture-500k|lecture-disc",
     "the lecture's settings: 10000 stored photons and k 100; 500000 and k 500; the same with "
     "a disc. Other options override it",
     "none"},
    {"only", "only", PM_OPTION_CHOICE, AT(only), 0, 0, 0,
     "emission|specular|volume|direct|caustic|indirect", "one layer of the picture", "all"},
    {"explain", "explain", PM_OPTION_FLAG, AT(explain), 0, 0, 0, "",
     "say what the scene requires and why, and stop", NULL},
    {"check", "check", PM_OPTION_FLAG, AT(check_scene), 0, 0, 0, "",
     "validate the scene and stop", NULL},
    {"check-file", "check", PM_OPTION_TEXT, AT(check_file), 0, 0, 0, "FILE",
     "check a photon file and stop; needs no scene", "none"},
    {"at", "at", PM_OPTION_POINT, AT(at), AT(has_at), 0, 0, "X,Y,Z", "a point [m]", "none"},
    {"normal", "normal", PM_OPTION_DIRECTION, AT(normal), AT(has_normal), 0, 0, "X,Y,Z",
     "the side looked at; made unit", "none"},
    {"points", "points", PM_OPTION_TEXT, AT(points), 0, 0, 0, "FILE",
     "points, a line each: x y z nx ny nz", "none"},
    {"on", "on", PM_OPTION_TEXT, AT(on), 0, 0, 0, "SHAPE",
     "id of a rectangle that --grid covers with points", "none"},
    {"grid", "grid", PM_OPTION_SIZE, AT(grid_w), 0, 1, 65536, "WxH", "points on --on", "none"},
    {"part", "part", PM_OPTION_PART, AT(part), AT(has_part), 0, 1, "U0,V0,U1,V1",
     "the part of --on that --grid covers, along its first and second edge", "0,0,1,1"},
    {"runs", "runs", PM_OPTION_COUNT32, AT(runs), 0, 1, 1e6, "M", "independent maps", NULL},
    {"photon", "photon", PM_OPTION_COUNT, AT(photon), AT(has_photon), 0, MANY, "I",
     "replay the photon of this index, event by event", "none"},
    {"map", "map", PM_OPTION_MAP, AT(map), 0, 0, 0, "FILE",
     "use a stored photon map; may be repeated", "none"},
    {"difference", "map", PM_OPTION_TEXT, AT(difference), 0, 0, 0, "FILE.png",
     "false-colour picture of the error", "none"},
    {"no-mask", "no-mask", PM_OPTION_FLAG, AT(no_mask), 0, 0, 0, "",
     "count lamps and the frame too", NULL},
    {"same", "same", PM_OPTION_FLAG, AT(same), 0, 0, 0, "",
     "answer whether the difference is a fault or noise", NULL},
    {"max-rel-mse", "max-rel-mse", PM_OPTION_REAL, AT(max_rel_mse), AT(has_max_rel_mse), 0,
     (double)INFINITY, "X", "exit 1 when rel_mse is above", "none"},
    {"o", "o", PM_OPTION_TEXT, AT(output), 0, 0, 0, "FILE", "file to write", "none"},
    {"png", "png", PM_OPTION_TEXT, AT(png), 0, 0, 0, "FILE", "also an 8-bit sRGB picture",
     "none"},
    {"exposure", "exposure", PM_OPTION_REAL, AT(exposure), 0, -100, 100, "E",
     "stops by which the PNG is made brighter", NULL},
    {"dump", "dump", PM_OPTION_TEXT, AT(dump), 0, 0, 0, "FILE.csv", "data, a line each",
     "none"},
    {"cells", "cells", PM_OPTION_TEXT, AT(cells), 0, 0, 0, "FILE.csv",
     "the cells of the projection maps, lit and dark", "none"},
    {"visits", "visits", PM_OPTION_TEXT, AT(visits), 0, 0, 0, "FILE.csv",
     "the photons that a search around --at looks at, in order", "none"},
    {"gathered", "gathered", PM_OPTION_TEXT, AT(gathered), 0, 0, 0, "FILE.csv",
     "the photons that the estimate at --at is made of", "none"},
    {"curves", "curves", PM_OPTION_TEXT, AT(curves), 0, 0, 0, "FILE.csv",
     "the kernels by distance, a line each", "none"},
    {"report", "report", PM_OPTION_TEXT, AT(report), 0, 0, 0, "FILE.json",
     "the JSON object as a file", "none"},
    {"title", "title", PM_OPTION_TEXT, AT(title), 0, 0, 0, "TEXT", "title of a picture",
     "none"},
    {"scene", "scene", PM_OPTION_TEXT, AT(scene), 0, 0, 0, "SCENE.xml",
     "the scene that the data came from", "none"},
    {"depth", "depth", PM_OPTION_COUNT32, AT(depth), 0, 1, 16, "D", "levels of a tree drawn",
     NULL},
    {"paths", "paths", PM_OPTION_COUNT32, AT(paths), 0, 1, 1e6, "N", "paths drawn at most",
     NULL},
    {"by", "by", PM_OPTION_CHOICE, AT(by), 0, 0, 0, "power|map|bounce|light|event",
     "what the colours stand for", "the first that the kind has"},
    {"light", "light", PM_OPTION_TEXT, AT(light), 0, 0, 0, "ID", "one light alone", "all"},
    {"frames", "frames", PM_OPTION_COUNT32, AT(frames), 0, 2, 999, "N", "pictures of a film",
     NULL},
    {"true", "true", PM_OPTION_POSITIVE, AT(truth), 0, 0, 1e30, "E",
     "what the estimates should be [W/m^2], above 0", "their median"},
    {"display", "display", PM_OPTION_SWITCH, AT(display_x), 0, 0, 0, "none|x",
     "draw without a display, or on the X display", NULL},
    {"interactive", "interactive", PM_OPTION_FLAG, AT(interactive), 0, 0, 0, "",
     "a window on the X display to look around in (h there lists keys)", NULL},
    {"seed", "seed", PM_OPTION_COUNT32, AT(seed), 0, 0, UINT32_ABOVE, "S",
     "of the random numbers", NULL},
    {"threads", "threads", PM_OPTION_COUNT32, AT(threads), 0, 1, 4096, "T", "threads", "all"},
    {"json", "json", PM_OPTION_FLAG, AT(json), 0, 0, 0, "",
     "one JSON object on standard output, nothing else there", NULL},
    {"D", "D", PM_OPTION_DEFINE, AT(define), 0, 0, 0, "NAME=VALUE",
     "set a <default> of the scene; may be repeated", "none"},
    {"help", "help", PM_OPTION_FLAG, AT(help), 0, 0, 0, "", "this text", NULL},
};

const pm_option *pm_option_at(int index)
{
    int count = (int)(sizeof table / sizeof table[0]);
    return index >= 0 && index < count ? &table[index] : NULL;
}

const pm_option *pm_option_find(const char *key)
{
    for (int i = 0; pm_option_at(i) != NULL; i++) {
        if (strcmp(table[i].key, key) == 0) {
            return &table[i];
        }
    }
    return NULL;
}

void pm_option_spell(const pm_option *option, char *text, size_t room)
{
    snprintf(text, room, "%s%s", strlen(option->name) == 1 ? "-" : "--", option->name);
}
