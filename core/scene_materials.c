// Every bsdf of the file becomes a material, whether a shape uses it or not, so that a fault in
// any of them is found. `twosided` is no material: it puts its own on both sides of a shape.
#include "ior.h"
#include "scene_build.h"
#include "scene_value.h"

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
    if (material == NULL) {
        return pm_scene_value_positive(source, bsdf, name, otherwise);
    }
    double index = otherwise;
    const char *nearest;
    if (!pm_ior_find(material, &index, &nearest)) {
        PM_FAULT(source, pm_scene_value_find(bsdf, name),
                 "%s \"%.60s\" is not a known material; the nearest is \"%s\"", name, material,
                 nearest);
    }
    return index;
}

static void read_conductor(pm_scene_file *source, const pm_xml *bsdf, pm_material *material)
{
    const char *metal = pm_scene_value_text(bsdf, "material", "none");
    bool eta = pm_scene_value_find(bsdf, "eta") != NULL;
    bool k = pm_scene_value_find(bsdf, "k") != NULL;
    if (strcmp(metal, "none") != 0) {
        PM_FAULT(source, pm_scene_value_find(bsdf, "material"),
                 "conductor material \"%.60s\" is not supported: write \"none\", or eta and k",
                 metal);
    }
    if (eta != k) {
        PM_FAULT(source, bsdf, "conductor needs both eta and k, or neither for a mirror");
    }
    material->perfect_mirror = !eta;
    material->eta = pm_scene_value_amount(source, bsdf, "eta", 1.0, true);
    material->k = pm_scene_value_amount(source, bsdf, "k", 0.0, false);
}

static void read_dielectric(pm_scene_file *source, const pm_xml *bsdf, pm_material *material)
{
    material->int_ior = read_ior(source, bsdf, "int_ior", 1.5046);
    material->ext_ior = read_ior(source, bsdf, "ext_ior", 1.000277);
    material->specular_transmittance =
        pm_scene_value_ratio(source, bsdf, "specular_transmittance", 1.0);
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
    if (is_type(bsdf, "diffuse")) {
        material->type = PM_BSDF_DIFFUSE;
        material->reflectance = pm_scene_value_ratio(source, bsdf, "reflectance", 0.5);
    } else if (is_type(bsdf, "dielectric")) {
        material->type = PM_BSDF_DIELECTRIC;
        read_dielectric(source, bsdf, material);
    } else if (is_type(bsdf, "conductor")) {
        material->type = PM_BSDF_CONDUCTOR;
        read_conductor(source, bsdf, material);
    }
    if (material->type == PM_BSDF_DIELECTRIC || material->type == PM_BSDF_CONDUCTOR) {
        material->specular_reflectance =
            pm_scene_value_ratio(source, bsdf, "specular_reflectance", 1.0);
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

/// One bsdf gives both sides; two give the front and the back.
static void read_twosided(pm_scene_file *source, const pm_xml *twosided, int material[2])
{
    pm_xml *inner[2] = {NULL, NULL};
    int count = find_bsdfs(source, twosided, 2, inner);
    if (count == 0) {
        PM_FAULT(source, twosided, "twosided needs a bsdf inside it");
    }
    for (int i = 0; i < count; i++) {
        if (is_type(inner[i], "dielectric") || is_type(inner[i], "null") ||
            is_type(inner[i], "twosided")) {
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
    bool both = is_type(bsdf, "dielectric") || is_type(bsdf, "null");
    material[1] = both ? bsdf->index : PM_NONE;
}
