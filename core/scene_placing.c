// The parts of scene_value that read points, vectors and transforms.
#include "number.h"
#include "scene_value.h"
#include "scene_words.h"

#include <math.h>
#include <string.h>

/// An axis written with three digits counts as having length 1.
#define UNIT 1e-3

static const char *text_of(const pm_xml *element, const char *attribute)
{
    const char *text = pm_xml_attribute(element, attribute);
    return text == pm_xml_faulty ? NULL : text;
}

/// The number in one attribute of `element`; `otherwise` when it is not there or at fault.
static double attribute_number(pm_scene_file *source, const pm_xml *element,
                               const char *attribute, double otherwise)
{
    const char *text = text_of(element, attribute);
    double number = otherwise;
    const char *wrong = text == NULL ? NULL : pm_number_read(text, &number);
    if (wrong != NULL) {
        PM_FAULT(source, element, "<%s> %s: \"%.60s\" %s", element->tag, attribute, text,
                 wrong);
    }
    return number;
}

/// `room` numbers in one attribute, or exactly `fewer`. The count; 0 after a fault.
static int attribute_numbers(pm_scene_file *source, const pm_xml *element,
                             const char *attribute, int room, int fewer, double *values)
{
    const char *text = text_of(element, attribute);
    int count = 0;
    if (text == NULL) {
        return 0;
    }
    const char *wrong = pm_number_list(text, values, room, &count);
    if (wrong != NULL) {
        PM_FAULT(source, element, "<%s> %s: \"%.60s\" %s", element->tag, attribute, text,
                 wrong);
        return 0;
    }
    if (count != room && count != fewer) {
        PM_FAULT(source, element, "<%s> %s takes %d numbers, got %d", element->tag, attribute,
                 room, count);
        return 0;
    }
    return count;
}

/// x, y and z, or one `value` of one or three numbers.
static pm_vec3 read_triple(pm_scene_file *source, const pm_xml *element, double otherwise)
{
    pm_vec3 v = {attribute_number(source, element, "x", otherwise),
                 attribute_number(source, element, "y", otherwise),
                 attribute_number(source, element, "z", otherwise)};
    if (text_of(element, "value") == NULL) {
        return v;
    }
    if (text_of(element, "x") != NULL || text_of(element, "y") != NULL ||
        text_of(element, "z") != NULL) {
        PM_FAULT(source, element, "<%s> takes either \"value\" or x, y and z", element->tag);
        return v;
    }
    double n[3];
    int count = attribute_numbers(source, element, "value", 3, 1, n);
    if (count == 0) {
        return v;
    }
    return count == 3 ? pm_vec(n[0], n[1], n[2]) : pm_vec(n[0], n[0], n[0]);
}

pm_vec3 pm_scene_value_triple(pm_scene_file *source, const pm_xml *object, const char *name,
                              pm_vec3 otherwise)
{
    const pm_xml *given = pm_scene_value_find(object, name);
    if (given == NULL || pm_scene_words_kinds(given->tag) != PM_WORD_TRIPLE) {
        return otherwise;
    }
    bool whole = pm_xml_attribute(given, "x") != NULL && pm_xml_attribute(given, "y") != NULL &&
                 pm_xml_attribute(given, "z") != NULL;
    if (!whole && pm_xml_attribute(given, "value") == NULL) {
        PM_FAULT(source, given, "<%s> needs x, y and z, or \"value\"", given->tag);
    }
    return read_triple(source, given, 0.0);
}

static pm_transform read_rotate(pm_scene_file *source, const pm_xml *element)
{
    pm_vec3 axis = read_triple(source, element, 0.0);
    double angle = attribute_number(source, element, "angle", 0.0);
    if (!(fabs(pm_vec_length(axis) - 1.0) <= UNIT)) {
        PM_FAULT(
            source, element,
            "<rotate> needs an axis of length 1, got length %g: Mitsuba does not normalise it",
            pm_vec_length(axis));
        return pm_transform_identity();
    }
    return pm_transform_rotate(axis, angle);
}

static pm_transform read_look_at(pm_scene_file *source, const pm_xml *element)
{
    double o[3] = {0.0, 0.0, 0.0};
    double t[3] = {0.0, 0.0, 1.0};
    double u[3] = {0.0, 0.0, 0.0};
    bool whole = attribute_numbers(source, element, "origin", 3, 3, o) == 3 &&
                 attribute_numbers(source, element, "target", 3, 3, t) == 3 &&
                 (text_of(element, "up") == NULL ||
                  attribute_numbers(source, element, "up", 3, 3, u) == 3);
    pm_transform look = pm_transform_look_at(pm_vec(o[0], o[1], o[2]), pm_vec(t[0], t[1], t[2]),
                                             pm_vec(u[0], u[1], u[2]));
    if (!whole) {
        return pm_transform_identity();
    }
    if (!isfinite(pm_vec_reach(look.column[0]) + pm_vec_length(look.column[2]))) {
        PM_FAULT(
            source, element,
            "<lookat> has no direction: target must differ from origin, and up must not run "
            "along the view");
        return pm_transform_identity();
    }
    return look;
}

/// 16 or 9 numbers, row by row.
static pm_transform read_matrix(pm_scene_file *source, const pm_xml *element)
{
    double n[16];
    int count = attribute_numbers(source, element, "value", 16, 9, n);
    pm_transform matrix = pm_transform_identity();
    if (count == 0) {
        return matrix;
    }
    int row = count == 16 ? 4 : 3;
    for (int i = 0; i < 3; i++) {
        matrix.column[i] = pm_vec(n[i], n[row + i], n[2 * row + i]);
    }
    if (count == 16) {
        matrix.origin = pm_vec(n[3], n[7], n[11]);
        if (n[12] != 0.0 || n[13] != 0.0 || n[14] != 0.0 || n[15] != 1.0) {
            PM_FAULT(source, element, "<matrix> must have 0 0 0 1 as its last row");
        }
    }
    return matrix;
}

static pm_transform read_step(pm_scene_file *source, const pm_xml *step)
{
    if (strcmp(step->tag, "translate") == 0) {
        return pm_transform_translate(read_triple(source, step, 0.0));
    }
    if (strcmp(step->tag, "scale") == 0) {
        return pm_transform_scale(read_triple(source, step, 1.0));
    }
    if (strcmp(step->tag, "rotate") == 0) {
        return read_rotate(source, step);
    }
    if (strcmp(step->tag, "lookat") == 0) {
        return read_look_at(source, step);
    }
    return strcmp(step->tag, "matrix") == 0 ? read_matrix(source, step)
                                            : pm_transform_identity();
}

pm_transform pm_scene_value_transform(pm_scene_file *source, const pm_xml *object,
                                      const char *name)
{
    const pm_xml *given = pm_scene_value_find(object, name);
    pm_transform whole = pm_transform_identity();
    if (given == NULL || pm_scene_words_kinds(given->tag) != PM_WORD_PLACING) {
        return whole;
    }
    for (const pm_xml *e = given->child; e != NULL; e = e->next) {
        pm_transform step = read_step(source, e);
        whole = pm_transform_then(&whole, &step);
    }
    double handedness = pm_transform_handedness(&whole);
    if (isnan(handedness) || handedness == 0.0 || !isfinite(pm_vec_reach(whole.origin))) {
        PM_FAULT(source, given, "transform %s is singular: it flattens space or overflows",
                 name);
        return pm_transform_identity();
    }
    return whole;
}
