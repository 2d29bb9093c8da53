// The tables.
#include "scene_words.h"

#include "nearest.h"

#include <stddef.h>
#include <string.h>

#define OBJECTS "shape bsdf emitter sensor film medium phase"
#define ROWS(table) ((int)(sizeof(table) / sizeof(table)[0]))

static const pm_word_element elements[] = {
    {"scene", "", "", "version id name"},
    {"default", "", "name value", ""},
    {"include", "", "filename", ""},
    {"integrator", "scene", "type", "id name"},
    {"sensor", "scene", "type", "id name"},
    {"sampler", "scene sensor", "type", "id name"},
    {"film", "sensor", "type", "id name"},
    {"rfilter", "film", "type", "id name"},
    {"bsdf", "scene shape bsdf", "type", "id name"},
    {"shape", "scene", "type", "id name"},
    {"emitter", "scene shape", "type", "id name"},
    {"medium", "scene shape sensor emitter", "type", "id name"},
    {"phase", "scene medium", "type", "id name"},
    {"ref", "shape bsdf sensor emitter medium", "id", "name"},
    {"float", OBJECTS, "name value", ""},
    {"integer", OBJECTS, "name value", ""},
    {"boolean", OBJECTS, "name value", ""},
    {"string", OBJECTS, "name value", ""},
    {"rgb", OBJECTS, "name value", ""},
    {"spectrum", OBJECTS, "name value", ""},
    {"point", OBJECTS, "name", "value x y z"},
    {"vector", OBJECTS, "name", "value x y z"},
    {"transform", OBJECTS, "name", ""},
    {"translate", "transform", "", "value x y z"},
    {"scale", "transform", "", "value x y z"},
    {"rotate", "transform", "angle", "value x y z"},
    {"lookat", "transform", "origin target", "up"},
    {"matrix", "transform", "value", ""},
};

#define IOR (PM_WORD_NUMBER | PM_WORD_TEXT)
#define TO_WORLD                                                                               \
    {                                                                                          \
        "to_world", PM_WORD_PLACING, false                                                     \
    }
#define FLIP                                                                                   \
    {                                                                                          \
        "flip_normals", PM_WORD_SWITCH, false                                                  \
    }
#define COLOUR(name)                                                                           \
    {                                                                                          \
        name, PM_WORD_COLOUR, false                                                            \
    }
#define ROUGHNESS                                                                              \
    {"alpha", PM_WORD_NUMBER, false},                                                          \
    {                                                                                          \
        "distribution", PM_WORD_TEXT, false                                                    \
    }
#define MESH                                                                                   \
    {                                                                                          \
        {"filename", PM_WORD_TEXT, true}, {"face_normals", PM_WORD_SWITCH, false}, TO_WORLD,   \
            FLIP,                                                                              \
        {                                                                                      \
            NULL, 0, false                                                                     \
        }                                                                                      \
    }

static const pm_word_plugin plugins[] = {
    {"sensor",
     "perspective",
     {{"fov", PM_WORD_NUMBER, false},
      {"fov_axis", PM_WORD_TEXT, false},
      {"near_clip", PM_WORD_NUMBER, false},
      {"far_clip", PM_WORD_NUMBER, false},
      TO_WORLD}},
    {"film", "hdrfilm", {{"width", PM_WORD_COUNT, false}, {"height", PM_WORD_COUNT, false}}},
    {"shape", "rectangle", {TO_WORLD, FLIP}},
    {"shape", "cube", {TO_WORLD, FLIP}},
    {"shape",
     "sphere",
     {{"center", PM_WORD_TRIPLE, false}, {"radius", PM_WORD_NUMBER, false}, TO_WORLD, FLIP}},
    {"shape", "disk", {TO_WORLD, FLIP}},
    {"shape",
     "cylinder",
     {{"p0", PM_WORD_TRIPLE, false},
      {"p1", PM_WORD_TRIPLE, false},
      {"radius", PM_WORD_NUMBER, false},
      TO_WORLD,
      FLIP}},
    {"shape", "ply", MESH},
    {"shape", "obj", MESH},
    {"bsdf", "diffuse", {COLOUR("reflectance")}},
    {"bsdf",
     "dielectric",
     {{"int_ior", IOR, false},
      {"ext_ior", IOR, false},
      COLOUR("specular_reflectance"),
      COLOUR("specular_transmittance")}},
    {"bsdf",
     "conductor",
     {{"material", PM_WORD_TEXT, false},
      COLOUR("eta"),
      COLOUR("k"),
      COLOUR("specular_reflectance")}},
    {"bsdf",
     "thindielectric",
     {{"int_ior", IOR, false},
      {"ext_ior", IOR, false},
      COLOUR("specular_reflectance"),
      COLOUR("specular_transmittance")}},
    {"bsdf",
     "roughconductor",
     {{"material", PM_WORD_TEXT, false},
      COLOUR("eta"),
      COLOUR("k"),
      COLOUR("specular_reflectance"),
      ROUGHNESS}},
    {"bsdf",
     "plastic",
     {{"int_ior", IOR, false},
      {"ext_ior", IOR, false},
      COLOUR("diffuse_reflectance"),
      COLOUR("specular_reflectance")}},
    {"bsdf",
     "roughplastic",
     {{"int_ior", IOR, false},
      {"ext_ior", IOR, false},
      COLOUR("diffuse_reflectance"),
      COLOUR("specular_reflectance"),
      ROUGHNESS}},
    {"bsdf", "twosided", {{NULL, 0, false}}},
    {"bsdf", "null", {{NULL, 0, false}}},
    {"emitter", "point", {{"position", PM_WORD_TRIPLE, false}, COLOUR("intensity"), TO_WORLD}},
    {"emitter",
     "directional",
     {{"direction", PM_WORD_TRIPLE, false}, COLOUR("irradiance"), TO_WORLD}},
    {"emitter", "area", {COLOUR("radiance")}},
    {"emitter",
     "spot",
     {COLOUR("intensity"),
      {"cutoff_angle", PM_WORD_NUMBER, false},
      {"beam_width", PM_WORD_NUMBER, false},
      TO_WORLD}},
    {"emitter", "constant", {COLOUR("radiance")}},
    {"medium",
     "homogeneous",
     {COLOUR("sigma_t"), COLOUR("albedo"), {"scale", PM_WORD_NUMBER, false}}},
    {"phase", "isotropic", {{NULL, 0, false}}},
    {"phase", "hg", {{"g", PM_WORD_NUMBER, false}}},
};

const pm_word_element *pm_scene_words_element(const char *tag)
{
    for (int i = 0; i < ROWS(elements); i++) {
        if (strcmp(elements[i].tag, tag) == 0) {
            return &elements[i];
        }
    }
    return NULL;
}

const pm_word_plugin *pm_scene_words_plugin(const char *tag, const char *type)
{
    for (int i = 0; i < ROWS(plugins); i++) {
        if (strcmp(plugins[i].tag, tag) == 0 && strcmp(plugins[i].type, type) == 0) {
            return &plugins[i];
        }
    }
    return NULL;
}

const pm_word_parameter *pm_scene_words_parameter(const pm_word_plugin *plugin,
                                                  const char *name)
{
    for (const pm_word_parameter *p = plugin->parameters; p->name != NULL; p++) {
        if (strcmp(p->name, name) == 0) {
            return p;
        }
    }
    return NULL;
}

const char *pm_scene_words_nearest_element(const char *tag)
{
    const char *known[ROWS(elements)];
    for (int i = 0; i < ROWS(elements); i++) {
        known[i] = elements[i].tag;
    }
    return pm_nearest_word(tag, known, ROWS(elements));
}

const char *pm_scene_words_nearest_plugin(const char *tag, const char *type)
{
    const char *known[ROWS(plugins)];
    int count = 0;
    for (int i = 0; i < ROWS(plugins); i++) {
        known[count] = plugins[i].type;
        count += strcmp(plugins[i].tag, tag) == 0;
    }
    return pm_nearest_word(type, known, count);
}

const char *pm_scene_words_nearest_parameter(const pm_word_plugin *plugin, const char *name)
{
    const char *known[8];
    int count = 0;
    for (const pm_word_parameter *p = plugin->parameters; p->name != NULL; p++) {
        known[count++] = p->name;
    }
    return pm_nearest_word(name, known, count);
}

int pm_scene_words_kinds(const char *tag)
{
    static const struct {
        const char *tag;
        int kinds;
    } kinds[] = {
        {"float", PM_WORD_NUMBER | PM_WORD_COLOUR},
        {"integer", PM_WORD_NUMBER | PM_WORD_COUNT},
        {"boolean", PM_WORD_SWITCH},
        {"string", PM_WORD_TEXT},
        {"point", PM_WORD_TRIPLE},
        {"vector", PM_WORD_TRIPLE},
        {"rgb", PM_WORD_COLOUR},
        {"spectrum", PM_WORD_COLOUR},
        {"transform", PM_WORD_PLACING},
    };
    for (int i = 0; i < ROWS(kinds); i++) {
        if (strcmp(kinds[i].tag, tag) == 0) {
            return kinds[i].kinds;
        }
    }
    return 0;
}

const char *pm_scene_words_spelling(int kinds)
{
    switch (kinds) {
    case PM_WORD_NUMBER:
        return "a <float>";
    case PM_WORD_COUNT:
        return "an <integer>";
    case PM_WORD_SWITCH:
        return "a <boolean>";
    case PM_WORD_TEXT:
        return "a <string>";
    case PM_WORD_TRIPLE:
        return "a <point> or <vector>";
    case PM_WORD_COLOUR:
        return "an <rgb>, <spectrum> or <float>";
    case PM_WORD_PLACING:
        return "a <transform>";
    default:
        return "a <float> or a <string>";
    }
}
