// Contracts are in the header. A wrong kind of parameter has been reported by scene_check; here
// it counts as not given.
#include "scene_value.h"

#include "number.h"
#include "scene_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

const pm_xml *pm_scene_value_find(const pm_xml *object, const char *name)
{
    for (const pm_xml *e = object->child; e != NULL; e = e->next) {
        const char *given = pm_xml_attribute(e, "name");
        if (given != NULL && strcmp(given, name) == 0) {
            return e;
        }
    }
    return NULL;
}

/// The element and the text of its value, when it is of one of `kinds` and not yet at fault.
static const char *value_of(const pm_xml *object, const char *name, int kinds,
                            const pm_xml **given)
{
    *given = pm_scene_value_find(object, name);
    if (*given == NULL || (pm_scene_words_kinds((*given)->tag) & kinds) == 0) {
        return NULL;
    }
    const char *value = pm_xml_attribute(*given, "value");
    return value == pm_xml_faulty ? NULL : value;
}

/// Where to report a fault in the value.
static const pm_xml *place_of(const pm_xml *object, const char *name)
{
    const pm_xml *given = pm_scene_value_find(object, name);
    return given == NULL ? object : given;
}

static const char *type_of(const pm_xml *object)
{
    const char *type = pm_xml_attribute(object, "type");
    return type == NULL ? object->tag : type;
}

double pm_scene_value_number(pm_scene_file *source, const pm_xml *object, const char *name,
                             double otherwise)
{
    const pm_xml *given;
    const char *text = value_of(object, name, PM_WORD_NUMBER, &given);
    double number = otherwise;
    const char *wrong = text == NULL ? NULL : pm_number_read(text, &number);
    if (wrong != NULL) {
        PM_FAULT(source, given, "%s %s: \"%.60s\" %s", type_of(object), name, text, wrong);
    }
    return number;
}

double pm_scene_value_positive(pm_scene_file *source, const pm_xml *object, const char *name,
                               double otherwise)
{
    double number = pm_scene_value_number(source, object, name, otherwise);
    if (number > 0.0) {
        return number;
    }
    PM_FAULT(source, place_of(object, name), "%s %s must be > 0, got %g", type_of(object), name,
             number);
    return otherwise;
}

int pm_scene_value_count(pm_scene_file *source, const pm_xml *object, const char *name,
                         int most, int otherwise)
{
    const pm_xml *given;
    const char *text = value_of(object, name, PM_WORD_COUNT, &given);
    if (text == NULL) {
        return otherwise;
    }
    char *end;
    long number = strtol(text, &end, 10);
    if (end == text || end[strspn(end, " \t\r\n")] != '\0') {
        PM_FAULT(source, given, "%s %s: \"%.60s\" is not a whole number", type_of(object), name,
                 text);
        return otherwise;
    }
    if (number < 1 || number > most) {
        PM_FAULT(source, given, "%s %s must lie in [1, %d], got %.60s", type_of(object), name,
                 most, text);
        return otherwise;
    }
    return (int)number;
}

bool pm_scene_value_switch(pm_scene_file *source, const pm_xml *object, const char *name,
                           bool otherwise)
{
    const pm_xml *given;
    const char *text = value_of(object, name, PM_WORD_SWITCH, &given);
    if (text == NULL) {
        return otherwise;
    }
    bool yes = strcasecmp(text, "true") == 0;
    if (!yes && strcasecmp(text, "false") != 0) {
        PM_FAULT(source, given, "%s %s must be true or false, got \"%.60s\"", type_of(object),
                 name, text);
    }
    return yes;
}

const char *pm_scene_value_text(const pm_xml *object, const char *name, const char *otherwise)
{
    const pm_xml *given;
    const char *text = value_of(object, name, PM_WORD_TEXT, &given);
    return text == NULL ? otherwise : text;
}

static pm_spectrum read_colour(pm_scene_file *source, const pm_xml *object, const char *name,
                               double otherwise)
{
    const pm_xml *given;
    const char *text = value_of(object, name, PM_WORD_COLOUR, &given);
    if (text == NULL) {
        return pm_gray(otherwise);
    }
    double value[3];
    int count = 0;
    const char *wrong = pm_number_list(text, value, 3, &count);
    bool triple = strcmp(given->tag, "rgb") == 0;
    if (wrong != NULL) {
        PM_FAULT(source, given, "%s %s: \"%.60s\" %s", type_of(object), name, text, wrong);
    } else if (count != 1 && !(triple && count == 3)) {
        PM_FAULT(source, given, "<%s> %s takes %s, got \"%.60s\"", given->tag, name,
                 triple ? "one or three numbers" : "one number", text);
    } else {
        return count == 1 ? pm_gray(value[0]) : pm_rgb(value[0], value[1], value[2]);
    }
    return pm_gray(otherwise);
}

/// The first channel that is not in the range, or 3.
static int outside(pm_spectrum value, double low, double high)
{
    int i = 0;
    while (i < 3 && value.c[i] >= low && value.c[i] <= high) {
        i++;
    }
    return i;
}

static const char *const channel_name[3] = {"red", "green", "blue"};

pm_spectrum pm_scene_value_ratio(pm_scene_file *source, const pm_xml *object, const char *name,
                                 double otherwise)
{
    pm_spectrum value = read_colour(source, object, name, otherwise);
    int i = outside(value, 0.0, 1.0);
    if (i == 3) {
        return value;
    }
    const pm_xml *given = place_of(object, name);
    PM_FAULT(source, given, "%s %s must lie in [0, 1], got %.15g in %s", given->tag, name,
             value.c[i], channel_name[i]);
    return pm_gray(otherwise);
}

pm_spectrum pm_scene_value_amount(pm_scene_file *source, const pm_xml *object, const char *name,
                                  double otherwise, bool positive)
{
    pm_spectrum value = read_colour(source, object, name, otherwise);
    int i = outside(value, positive ? nextafter(0.0, 1.0) : 0.0, HUGE_VAL);
    if (i == 3) {
        return value;
    }
    const pm_xml *given = place_of(object, name);
    PM_FAULT(source, given, "%s %s must be %s 0, got %g in %s", given->tag, name,
             positive ? ">" : ">=", value.c[i], channel_name[i]);
    return pm_gray(otherwise);
}

pm_spectrum pm_scene_value_emission(pm_scene_file *source, const pm_xml *object,
                                    const char *name)
{
    // XYZ (1, 1, 1) in linear sRGB (Rec. 709 primaries, D65 white).
    const pm_spectrum equal_energy = pm_rgb(1.204794, 0.948291, 0.908916);
    pm_spectrum value = pm_scene_value_amount(source, object, name, 1.0, false);
    const pm_xml *given = pm_scene_value_find(object, name);
    bool one_value = given != NULL && strcmp(given->tag, "spectrum") == 0;
    return one_value ? pm_spectrum_mul(value, equal_energy) : value;
}
