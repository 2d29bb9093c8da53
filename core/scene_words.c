// The tables. What is planned for later is listed as `later`, so that it is refused as "not
// yet" and not as unknown.
#include "scene_words.h"

#include "nearest.h"

#include <stddef.h>
#include <string.h>

#define OBJECTS "shape bsdf emitter sensor film"
#define ROWS(table) ((int)(sizeof(table) / sizeof(table)[0]))

static const pm_word_element elements[] = {
    {"scene", "", "", "version id name", false},
    {"default", "", "name value", "", false},
    {"include", "", "filename", "", false},
    {"integrator", "scene", "type", "id name", false},
    {"sensor", "scene", "type", "id name", false},
    {"sampler", "scene sensor", "type", "id name", false},
    {"film", "sensor", "type", "id name", false},
    {"rfilter", "film", "type", "id name", false},
    {"bsdf", "scene shape bsdf", "type", "id name", false},
    {"shape", "scene", "type", "id name", false},
    {"emitter", "scene shape", "type", "id name", false},
    {"medium", "scene shape sensor emitter", "type", "id name", true},
    {"phase", "scene medium", "type", "id name", true},
    {"ref", "shape bsdf", "id", "name", false},
    {"float", OBJECTS, "name value", "", false},
    {"integer", OBJECTS, "name value", "", false},
    {"boolean", OBJECTS, "name value", "", false},
    {"string", OBJECTS, "name value", "", false},
    {"rgb", OBJECTS, "name value", "", false},
    {"spectrum", OBJECTS, "name value", "", false},
    {"point", OBJECTS, "name", "value x y z", false},
    {"vector", OBJECTS, "name", "value x y z", false},
    {"transform", OBJECTS, "name", "", false},
    {"translate", "transform", "", "value x y z", false},
    {"scale", "transform", "", "value x y z", false},
    {"rotate", "transform", "angle", "value x y z", false},
    {"lookat", "transform", "origin target", "up", false},
    {"matrix", "transform", "value", "", false},
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
      TO_WORLD},
     false},
    {"film",
     "hdrfilm",
     {{"width", PM_WORD_COUNT, false}, {"height", PM_WORD_COUNT, false}},
     false},
    {"shape", "rectangle", {TO_WORLD, FLIP}, false},
    {"shape", "cube", {TO_WORLD, FLIP}, false},
    {"shape",
     "sphere",
     {{"center", PM_WORD_TRIPLE, false}, {"radius", PM_WORD_NUMBER, false}, TO_WORLD, FLIP},
     false},
    {"shape", "disk", {TO_WORLD, FLIP}, false},
    {"shape",
     "cylinder",
     {{"p0", PM_WORD_TRIPLE, false},
      {"p1", PM_WORD_TRIPLE, false},
      {"radius", PM_WORD_NUMBER, false},
      TO_WORLD,
      FLIP},
     false},
    {"shape", "ply", MESH, false},
    {"shape", "obj", MESH, false},
    {"bsdf", "diffuse", {COLOUR("reflectance")}, false},
    {"bsdf",
     "dielectric",
     {{"int_ior", IOR, false},
      {"ext_ior", IOR, false},
      COLOUR("specular_reflectance"),
      COLOUR("specular_transmittance")},
     false},
    {"bsdf",
     "conductor",
     {{"material", PM_WORD_TEXT, false},
      COLOUR("eta"),
      COLOUR("k"),
      COLOUR("specular_reflectance")},
     false},
    {"bsdf",
     "thindielectric",
     {{"int_ior", IOR, false},
      {"ext_ior", IOR, false},
      COLOUR("specular_reflectance"),
      COLOUR("specular_transmittance")},
     false},
    {"bsdf",
     "roughconductor",
     {{"material", PM_WORD_TEXT, false},
      COLOUR("eta"),
      COLOUR("k"),
      COLOUR("specular_reflectance"),
      ROUGHNESS},
     false},
    {"bsdf",
     "plastic",
     {{"int_ior", IOR, false},
      {"ext_ior", IOR, false},
      COLOUR("diffuse_reflectance"),
      COLOUR("specular_reflectance")},
     false},
    {"bsdf",
     "roughplastic",
     {{"int_ior", IOR, false},
      {"ext_ior", IOR, false},
      COLOUR("diffuse_reflectance"),
      COLOUR("specular_reflectance"),
      ROUGHNESS},
     false},
    {"bsdf", "twosided", {{NULL, 0, false}}, false},
    {"bsdf", "null", {{NULL, 0, false}}, false},
    {"emitter",
     "point",
     {{"position", PM_WORD_TRIPLE, false}, COLOUR("intensity"), TO_WORLD},
     false},
    {"emitter",
     "directional",
     {{"direction", PM_WORD_TRIPLE, false}, COLOUR("irradiance"), TO_WORLD},
     false},
    {"emitter", "area", {COLOUR("radiance")}, false},
    {"emitter",
     "spot",
     {COLOUR("intensity"),
      {"cutoff_angle", PM_WORD_NUMBER, false},
      {"beam_width", PM_WORD_NUMBER, false},
      TO_WORLD},
     false},
    {"emitter", "constant", {COLOUR("radiance")}, false},
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
    int count = 0;
    for (int i = 0; i < ROWS(elements); i++) {
        known[count] = elements[i].tag;
        count += !elements[i].later;
    }
    return pm_nearest_word(tag, known, count);
}

const char *pm_scene_words_nearest_plugin(const char *tag, const char *type)
{
    const char *known[ROWS(plugins)];
    int count = 0;
    for (int i = 0; i < ROWS(plugins); i++) {
        known[count] = plugins[i].type;
        count += !plugins[i].later && strcmp(plugins[i].tag, tag) == 0;
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
