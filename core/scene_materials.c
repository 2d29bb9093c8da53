// Every bsdf of the file becomes a material, whether a shape uses it or not, so that a fault in
// any of them is found. `twosided` is no material: it puts its own on both sides of a shape.
#include "ior.h"
#include "material.h"
#include "microfacet.h"
#include "nearest.h"
#include "scene_build.h"
#include "scene_value.h"

#include <stdio.h>
#include <string.h>

enum { TWOSIDED_AT_FAULT = PM_NONE - 1 };

static bool is_type(const pm_xml *object, const char *type)
{
    const char *given = pm_xml_attribute(object, "type");
    return given != NULL && strcmp(given, type) == 0;
}

static double read_ior(pm_scene_file *source, const pm_xml *bsdf, const char *name,
                       double otherwise)
{
    const char *material = pm_scene_value_text(bsdf, name, NULL);
    double index = otherwise;
    if (material == NULL) {
        index = pm_scene_value_positive(source, bsdf, name, otherwise);
        // Beyond, a square of a ratio of two has no value.
        if (index < 1e-50 || index > 1e50) {
            PM_FAULT(source, pm_scene_value_find(bsdf, name),
                     "%s must lie in [1e-50, 1e50], got %g", name, index);
        }
        return index;
    }
    const char *nearest;
    if (!pm_ior_find(material, &index, &nearest)) {
        PM_FAULT(source, pm_scene_value_find(bsdf, name),
                 "%s \"%.60s\" is not a known material; the nearest is \"%s\"", name, material,
                 nearest);
    }
    return index;
}

static void read_metal(pm_scene_file *source, const pm_xml *bsdf, pm_material *material)
{
    const char *type = pm_xml_attribute(bsdf, "type");
    const char *metal = pm_scene_value_text(bsdf, "material", "none");
    bool eta = pm_scene_value_find(bsdf, "eta") != NULL;
    bool k = pm_scene_value_find(bsdf, "k") != NULL;
    if (strcmp(metal, "none") != 0) {
        PM_FAULT(source, pm_scene_value_find(bsdf, "material"),
                 "%s material \"%.60s\" is not supported: write \"none\", or eta and k", type,
                 metal);
    }
    if (eta != k) {
        PM_FAULT(source, bsdf, "%s needs both eta and k, or neither for a mirror", type);
    }
    material->perfect_mirror = !eta;
    material->eta = pm_scene_value_amount(source, bsdf, "eta", 1.0, true);
    material->k = pm_scene_value_amount(source, bsdf, "k", 0.0, false);
    if (pm_spectrum_max(material->eta) > 1e50 || pm_spectrum_max(material->k) > 1e50) {
        PM_FAULT(source, bsdf, "%s eta and k must be at most 1e50", type);
    }
}

/// The glass that an instruction of these words names; NULL after a fault.
static const pm_glass *read_instruction(pm_scene_file *source, const pm_xml *instruction)
{
    const char *text = pm_xml_attribute(instruction, "text");
    char word[8] = "";
    char name[64] = "";
    char more[2];
    if (text == pm_xml_faulty) {
        return NULL;
    }
    if (sscanf(text, "%7s %63s %1s", word, name, more) != 2 || strcmp(word, "glass") != 0) {
        PM_FAULT(source, instruction,
                 "<?photonlab %.60s?> is not known; what is known is <?photonlab glass NAME?>",
                 text);
        return NULL;
    }
    const pm_glass *glass = pm_glass_named(name);
    if (glass == NULL) {
        PM_FAULT(source, instruction, "glass \"%s\" is not known; the nearest is \"%s\"", name,
                 pm_glass_nearest(name));
    }
    return glass;
}

/// The glass whose index follows the wavelength, or NULL.
static const pm_glass *read_dispersion(pm_scene_file *source, const pm_xml *bsdf)
{
    const pm_xml *first = NULL;
    const pm_glass *glass = NULL;
    for (const pm_xml *e = bsdf->child; e != NULL; e = e->next) {
        if (strcmp(e->tag, PM_XML_INSTRUCTION) != 0) {
            continue;
        }
        if (first != NULL) {
            PM_FAULT(source, e, "a dielectric takes at most one glass; there is one at line %d",
                     first->line);
            continue;
        }
        first = e;
        glass = read_instruction(source, e);
    }
    return glass;
}

static void read_glass(pm_scene_file *source, const pm_xml *bsdf, pm_material *material)
{
    material->int_ior = read_ior(source, bsdf, "int_ior", 1.5046);
    material->ext_ior = read_ior(source, bsdf, "ext_ior", 1.000277);
    material->specular_transmittance =
        pm_scene_value_ratio(source, bsdf, "specular_transmittance", 1.0);
}

static void read_dielectric(pm_scene_file *source, const pm_xml *bsdf, pm_material *material)
{
    read_glass(source, bsdf, material);
    material->glass = read_dispersion(source, bsdf);
}

static void read_plastic(pm_scene_file *source, const pm_xml *bsdf, pm_material *material)
{
    material->int_ior = read_ior(source, bsdf, "int_ior", 1.49);
    material->ext_ior = read_ior(source, bsdf, "ext_ior", 1.000277);
    material->reflectance = pm_scene_value_ratio(source, bsdf, "diffuse_reflectance", 0.5);
}

static void read_roughness(pm_scene_file *source, const pm_xml *bsdf, pm_material *material)
{
    // Mitsuba takes what lies below this as this; in silence that would be wrong here.
    material->alpha = pm_scene_value_positive(source, bsdf, "alpha", 0.1);
    if (material->alpha < PM_ALPHA_LEAST || material->alpha > PM_ALPHA_MOST) {
        PM_FAULT(source, pm_scene_value_find(bsdf, "alpha"),
                 "%s alpha must lie in [%g, %g], got %g; a smooth one is a %s",
                 pm_xml_attribute(bsdf, "type"), PM_ALPHA_LEAST, PM_ALPHA_MOST, material->alpha,
                 pm_xml_attribute(bsdf, "type") + strlen("rough"));
    }
    static const char *const known[2] = {"beckmann", "ggx"};
    const char *kind = pm_scene_value_text(bsdf, "distribution", known[0]);
    bool ggx = strcmp(kind, known[1]) == 0;
    if (!ggx && strcmp(kind, known[0]) != 0) {
        PM_FAULT(source, pm_scene_value_find(bsdf, "distribution"),
                 "distribution must be beckmann or ggx, got \"%.60s\"; the nearest is \"%s\"",
                 kind, pm_nearest_word(kind, known, 2));
    }
    material->microfacet = ggx ? PM_MICROFACET_GGX : PM_MICROFACET_BECKMANN;
}

/// How each type is read; what transmits lies on both sides of a shape.
static const struct bsdf_row {
    const char *word;
    pm_bsdf_type type;
    void (*read)(pm_scene_file *source, const pm_xml *bsdf, pm_material *material);
    bool rough, transmits;
} bsdf_rows[] = {
    {"diffuse", PM_BSDF_DIFFUSE, NULL, false, false},
    {"dielectric", PM_BSDF_DIELECTRIC, read_dielectric, false, true},
    {"thindielectric", PM_BSDF_THIN_DIELECTRIC, read_glass, false, true},
    {"conductor", PM_BSDF_CONDUCTOR, read_metal, false, false},
    {"roughconductor", PM_BSDF_ROUGH_CONDUCTOR, read_metal, true, false},
    {"plastic", PM_BSDF_PLASTIC, read_plastic, false, false},
    {"roughplastic", PM_BSDF_ROUGH_PLASTIC, read_plastic, true, false},
    {"null", PM_BSDF_NULL, NULL, false, true},
};

/// The row of its type; NULL when the words have been found wrong already.
static const struct bsdf_row *row_of(const pm_xml *bsdf)
{
    for (size_t i = 0; i < sizeof bsdf_rows / sizeof *bsdf_rows; i++) {
        if (is_type(bsdf, bsdf_rows[i].word)) {
            return &bsdf_rows[i];
        }
    }
    return NULL;
}

static void read_bsdf(pm_scene_file *source, pm_xml *bsdf, pm_material *material)
{
    *material = (pm_material){.type = PM_BSDF_NULL, .line = bsdf->line};
    material->id = pm_scene_file_name(source, bsdf);
    for (const pm_xml *e = bsdf->child; e != NULL; e = e->next) {
        if (strcmp(e->tag, "bsdf") == 0 || strcmp(e->tag, "ref") == 0) {
            PM_FAULT(source, e, "only twosided takes a bsdf inside it");
        }
    }
    const struct bsdf_row *row = row_of(bsdf);
    if (row == NULL || row->type == PM_BSDF_NULL) {
        return;
    }
    int before = source->faults.count;
    material->type = row->type;
    if (row->type == PM_BSDF_DIFFUSE) {
        material->reflectance = pm_scene_value_ratio(source, bsdf, "reflectance", 0.5);
        return;
    }
    row->read(source, bsdf, material);
    material->specular_reflectance =
        pm_scene_value_ratio(source, bsdf, "specular_reflectance", 1.0);
    if (row->rough) {
        read_roughness(source, bsdf, material);
    }
    if (source->faults.count == before) {
        pm_material_prepare(material);
    }
}

/// The bsdf that a child of a shape or of a twosided bsdf stands for; NULL when it is none.
static pm_xml *bsdf_of(pm_scene_file *source, pm_xml *child)
{
    if (strcmp(child->tag, "bsdf") == 0) {
        return child;
    }
    if (strcmp(child->tag, "ref") != 0) {
        return NULL;
    }
    pm_xml *meant = pm_scene_file_resolve(source, child);
    if (meant != NULL && strcmp(child->parent->tag, "shape") == 0 &&
        (strcmp(meant->tag, "medium") == 0 || pm_scene_build_names_side(child))) {
        return NULL;
    }
    if (meant != NULL && strcmp(meant->tag, "bsdf") != 0) {
        PM_FAULT(source, child, "ref id \"%.60s\" names <%s>; only a bsdf can stand here",
                 pm_xml_attribute(child, "id"), meant->tag);
        return NULL;
    }
    return meant;
}

/// Up to `room` bsdfs inside `parent`; more are a fault. Their number.
static int find_bsdfs(pm_scene_file *source, const pm_xml *parent, int room, pm_xml **bsdfs)
{
    int found = 0;
    for (pm_xml *e = parent->child; e != NULL; e = e->next) {
        pm_xml *bsdf = bsdf_of(source, e);
        if (bsdf != NULL && found == room) {
            PM_FAULT(source, e, "<%s> takes at most %d bsdf", parent->tag, room);
            return found;
        }
        if (bsdf != NULL) {
            bsdfs[found++] = bsdf;
        }
    }
    return found;
}

static bool transmits(const pm_xml *bsdf)
{
    const struct bsdf_row *row = row_of(bsdf);
    return row != NULL && row->transmits;
}

/// One bsdf gives both sides; two give the front and the back.
static void read_twosided(pm_scene_file *source, const pm_xml *twosided, int material[2])
{
    pm_xml *inner[2] = {NULL, NULL};
    int count = find_bsdfs(source, twosided, 2, inner);
    if (count == 0) {
        PM_FAULT(source, twosided, "twosided needs a bsdf inside it");
    }
    for (int i = 0; i < count; i++) {
        if (transmits(inner[i]) || is_type(inner[i], "twosided")) {
            PM_FAULT(source, twosided,
                     "twosided cannot hold a %s bsdf: it has both sides itself",
                     pm_xml_attribute(inner[i], "type"));
        }
        material[i] = inner[i]->index;
    }
    material[1] = count == 1 ? material[0] : material[1];
}

static void check_twosided(pm_scene_file *source, pm_xml *twosided)
{
    int before = source->faults.count;
    int material[2];
    read_twosided(source, twosided, material);
    twosided->index = source->faults.count == before ? PM_NONE : TWOSIDED_AT_FAULT;
}

static int default_material(pm_scene_file *source, const pm_xml *shape)
{
    pm_scene *scene = &source->scene;
    for (const pm_xml *e = shape->child; e != NULL; e = e->next) {
        if (strcmp(e->tag, "emitter") == 0) {
            pm_scene_file_note(
                source, shape,
                "this light has no bsdf: it reflects 0.5 here, as any shape does, "
                "and nothing in Mitsuba; write a bsdf to have both alike");
        }
    }
    if (source->plain == PM_NONE) {
        source->plain = scene->material_count++;
        scene->materials[source->plain] = (pm_material){.type = PM_BSDF_DIFFUSE,
                                                        .id = "default",
                                                        .line = shape->line,
                                                        .reflectance = pm_gray(0.5)};
    }
    return source->plain;
}

void pm_scene_build_materials(pm_scene_file *source)
{
    pm_scene *scene = &source->scene;
    // One more for shapes without a bsdf.
    size_t room = (size_t)pm_scene_file_count(source, "bsdf") + 1;
    scene->materials = pm_scene_file_take(source, room, sizeof *scene->materials);
    if (scene->materials == NULL) {
        return;
    }
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        if (strcmp(e->tag, "bsdf") == 0 && !is_type(e, "twosided")) {
            e->index = scene->material_count++;
            read_bsdf(source, e, &scene->materials[e->index]);
        }
    }
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        if (strcmp(e->tag, "bsdf") == 0 && is_type(e, "twosided")) {
            check_twosided(source, e);
        }
    }
}

void pm_scene_build_sides(pm_scene_file *source, const pm_xml *shape, int material[2])
{
    pm_xml *bsdf = NULL;
    material[0] = PM_NONE;
    material[1] = PM_NONE;
    if (find_bsdfs(source, shape, 1, &bsdf) == 0) {
        material[0] = default_material(source, shape);
        return;
    }
    if (is_type(bsdf, "twosided")) {
        // Its faults have been told once; a clean one is read again for each shape.
        if (bsdf->index != TWOSIDED_AT_FAULT) {
            read_twosided(source, bsdf, material);
        }
        return;
    }
    material[0] = bsdf->index;
    material[1] = transmits(bsdf) ? bsdf->index : PM_NONE;
}
