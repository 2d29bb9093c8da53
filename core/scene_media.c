// Every medium of the file is read, whether something uses it or not, so that a fault in any of
// them is found; what nothing uses is dropped at the end. Defaults are Mitsuba's.
#include "scene_build.h"
#include "scene_value.h"

#include <math.h>
#include <string.h>

/// One coefficient for all three channels: distances are drawn for all of them at once.
static double read_extinction(pm_scene_file *source, const pm_xml *medium)
{
    pm_spectrum sigma_t = pm_scene_value_amount(source, medium, "sigma_t", 1.0, false);
    double scale = pm_scene_value_number(source, medium, "scale", 1.0);
    const pm_xml *given = pm_scene_value_find(medium, "sigma_t");
    if (sigma_t.c[0] != sigma_t.c[1] || sigma_t.c[0] != sigma_t.c[2]) {
        PM_FAULT(
            source, given,
            "sigma_t must be the same in all channels, got %g %g %g; the albedo may have a "
            "colour",
            sigma_t.c[0], sigma_t.c[1], sigma_t.c[2]);
    } else if (!(scale >= 0.0)) {
        PM_FAULT(source, pm_scene_value_find(medium, "scale"),
                 "homogeneous scale must be >= 0, got %g", scale);
    } else if (!isfinite(sigma_t.c[0] * scale)) {
        PM_FAULT(source, medium, "sigma_t times scale must be finite, got %g times %g",
                 sigma_t.c[0], scale);
    } else if (sigma_t.c[0] > 1.0 && strcmp(given->tag, "rgb") == 0) {
        pm_scene_file_note(source, given,
                           "Mitsuba takes an <rgb> sigma_t only up to 1; write a <float>");
    }
    return sigma_t.c[0] * scale;
}

static double read_phase(pm_scene_file *source, const pm_xml *phase)
{
    const char *type = pm_xml_attribute(phase, "type");
    if (type == NULL || strcmp(type, "hg") != 0) {
        return 0.0;
    }
    double g = pm_scene_value_number(source, phase, "g", 0.8);
    if (!(g > -1.0 && g < 1.0)) {
        PM_FAULT(source, pm_scene_value_find(phase, "g"),
                 "hg g must lie between -1 and 1, both excluded, got %g", g);
    }
    return g;
}

/// What a child of an object is, or what the <ref> it is means; a fault when a <ref> means
/// anything but a <tag>.
static const pm_xml *meant_as(pm_scene_file *source, const pm_xml *child, const char *tag)
{
    if (strcmp(child->tag, "ref") != 0) {
        return strcmp(child->tag, tag) == 0 ? child : NULL;
    }
    const pm_xml *meant = pm_scene_file_resolve(source, child);
    if (meant != NULL && strcmp(meant->tag, tag) != 0) {
        PM_FAULT(source, child, "ref id \"%.60s\" names <%s>; only a %s can stand here",
                 pm_xml_attribute(child, "id"), meant->tag, tag);
        return NULL;
    }
    return meant;
}

/// The only <tag> inside `object` or meant there by a <ref>, or NULL; more are a fault.
static const pm_xml *only_one(pm_scene_file *source, const pm_xml *object, const char *tag)
{
    const pm_xml *first = NULL;
    const pm_xml *place = NULL;
    for (const pm_xml *e = object->child; e != NULL; e = e->next) {
        const pm_xml *meant = meant_as(source, e, tag);
        if (meant != NULL && first != NULL) {
            PM_FAULT(source, e, "<%s> takes at most one %s; there is one at line %d",
                     object->tag, tag, place->line);
        } else if (meant != NULL) {
            first = meant;
            place = e;
        }
    }
    return first;
}

static void read_medium(pm_scene_file *source, const pm_xml *element, const double *g,
                        pm_medium *medium)
{
    medium->id = pm_scene_file_name(source, element);
    medium->line = element->line;
    medium->sigma_t = read_extinction(source, element);
    medium->albedo = pm_scene_value_ratio(source, element, "albedo", 0.75);
    const pm_xml *phase = only_one(source, element, "phase");
    medium->g = phase == NULL ? 0.0 : g[phase->index];
}

/// The mean cosine of every phase function, whose elements learn their index: each is read
/// once, however many media refer to it. NULL without memory.
static const double *read_phases(pm_scene_file *source)
{
    double *g =
        pm_arena_take(&source->tree, (size_t)pm_scene_file_count(source, "phase"), sizeof *g);
    int count = 0;
    for (pm_xml *e = source->root; g != NULL && e != NULL;
         e = pm_xml_following(source->root, e)) {
        if (strcmp(e->tag, "phase") == 0) {
            e->index = count++;
            g[e->index] = read_phase(source, e);
        }
    }
    return g;
}

void pm_scene_build_media(pm_scene_file *source)
{
    pm_scene *scene = &source->scene;
    const double *g = read_phases(source);
    size_t count = (size_t)pm_scene_file_count(source, "medium");
    scene->media = pm_scene_file_take(source, count, sizeof *scene->media);
    if (scene->media == NULL || g == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        if (strcmp(e->tag, "medium") == 0) {
            e->index = scene->medium_count++;
            read_medium(source, e, g, &scene->media[e->index]);
        }
    }
}

static bool is_named(const pm_xml *child, const char *name)
{
    const char *given = pm_xml_attribute(child, "name");
    return given != NULL && strcmp(given, name) == 0;
}

bool pm_scene_build_names_side(const pm_xml *child)
{
    return is_named(child, "interior") || is_named(child, "exterior");
}

/// One child of a shape that is a medium or a <ref> to one.
static void read_side(pm_scene_file *source, const pm_xml *child, const pm_xml *medium,
                      pm_shape *shape)
{
    int *side = NULL;
    if (is_named(child, "interior")) {
        side = &shape->interior;
    } else if (is_named(child, "exterior")) {
        side = &shape->exterior;
    }
    if (side == NULL) {
        PM_FAULT(source, child,
                 "a medium inside a shape needs name=\"interior\" or name=\"exterior\"");
        return;
    }
    if (*side != PM_NONE) {
        PM_FAULT(source, child, "a shape takes at most one %s medium",
                 pm_xml_attribute(child, "name"));
    }
    *side = medium->index;
    shape->boundary = true;
}

void pm_scene_build_boundary(pm_scene_file *source, const pm_xml *element, pm_shape *shape)
{
    for (const pm_xml *e = element->child; e != NULL; e = e->next) {
        bool ref = strcmp(e->tag, "ref") == 0;
        // A <ref> that means nothing was reported with the bsdfs.
        const pm_xml *meant = ref ? pm_scene_file_find(source, e) : e;
        if (meant != NULL && strcmp(meant->tag, "medium") == 0) {
            read_side(source, e, meant, shape);
        } else if (meant != NULL && ref && pm_scene_build_names_side(e)) {
            PM_FAULT(source, e, "%s takes a medium, and \"%.60s\" is a %s",
                     pm_xml_attribute(e, "name"), pm_xml_attribute(e, "id"), meant->tag);
        }
    }
}

int pm_scene_build_stand(pm_scene_file *source, const pm_xml *object)
{
    const pm_xml *medium = only_one(source, object, "medium");
    return medium == NULL ? PM_NONE : medium->index;
}

/// The index of a medium that stands at place number `i` of the scene: the sides of all shapes,
/// then all lights, then the camera; NULL behind the last one.
static int *index_at(pm_scene *scene, int64_t i)
{
    int64_t sides = 2 * (int64_t)scene->shape_count;
    if (i < sides) {
        pm_shape *shape = &scene->shapes[i / 2];
        return i % 2 == 0 ? &shape->interior : &shape->exterior;
    }
    if (i < sides + scene->light_count) {
        return &scene->lights[i - sides].medium;
    }
    return i == sides + scene->light_count ? &scene->camera.medium : NULL;
}

/// Sets used[i] for every medium that something refers to, and notes the others.
static void find_used(pm_scene_file *source, int *used)
{
    int *index;
    for (int64_t i = 0; (index = index_at(&source->scene, i)) != NULL; i++) {
        if (*index != PM_NONE) {
            used[*index] = 1;
        }
    }
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        if (strcmp(e->tag, "medium") == 0 && used[e->index] == 0) {
            pm_scene_file_note(source, e, "nothing is in this medium: it is not used");
        }
    }
}

void pm_scene_drop_media(pm_scene_file *source)
{
    pm_scene *scene = &source->scene;
    int *place = pm_arena_take(&source->tree, (size_t)scene->medium_count, sizeof *place);
    if (place == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    find_used(source, place);
    int kept = 0;
    for (int i = 0; i < scene->medium_count; i++) {
        if (place[i] != 0) {
            scene->media[kept] = scene->media[i];
            place[i] = kept++;
        }
    }
    scene->medium_count = kept;
    int *index;
    for (int64_t i = 0; (index = index_at(scene, i)) != NULL; i++) {
        *index = *index == PM_NONE ? PM_NONE : place[*index];
    }
}
