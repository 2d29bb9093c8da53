// One walk over the tree, parents before children.
#include "scene_check.h"

#include "scene_words.h"
#include "word.h"

#include <string.h>

static void check_needed(pm_scene_file *source, const pm_xml *element, const char *needs)
{
    while (*needs != '\0') {
        char name[16];
        size_t length = strcspn(needs, " ");
        memcpy(name, needs, length);
        name[length] = '\0';
        if (pm_xml_attribute(element, name) == NULL) {
            PM_FAULT(source, element, "<%s> needs the attribute \"%s\"", element->tag, name);
        }
        needs += length;
        needs += strspn(needs, " ");
    }
}

static void check_attributes(pm_scene_file *source, const pm_xml *element,
                             const pm_word_element *word)
{
    for (const char **a = element->attributes; *a != NULL; a += 2) {
        if (!pm_word_listed(a[0], word->needs, ' ') &&
            !pm_word_listed(a[0], word->may_have, ' ')) {
            PM_FAULT(source, element, "<%s> takes no attribute \"%.60s\"", element->tag, a[0]);
        }
    }
    check_needed(source, element, word->needs);
}

/// The plugin of an object; NULL when there is none, or after a fault.
static const pm_word_plugin *check_type(pm_scene_file *source, const pm_xml *object)
{
    const char *type = pm_xml_attribute(object, "type");
    const char *nearest = pm_scene_words_nearest_plugin(object->tag, "");
    if (nearest == NULL || type == NULL || type == pm_xml_faulty) {
        return NULL;
    }
    const pm_word_plugin *plugin = pm_scene_words_plugin(object->tag, type);
    if (plugin == NULL) {
        PM_FAULT(source, object,
                 "%s type \"%.60s\" is not supported; the nearest known type is \"%s\"",
                 object->tag, type, pm_scene_words_nearest_plugin(object->tag, type));
    }
    return plugin;
}

/// Coefficients that Mitsuba does not take either.
static bool is_scattering(const pm_word_plugin *plugin, const char *name)
{
    return strcmp(plugin->tag, "medium") == 0 &&
           (strcmp(name, "sigma_s") == 0 || strcmp(name, "sigma_a") == 0);
}

static void check_parameter(pm_scene_file *source, const pm_xml *given,
                            const pm_word_plugin *plugin)
{
    const char *name = pm_xml_attribute(given, "name");
    if (name == NULL || name == pm_xml_faulty) {
        return;
    }
    const pm_word_parameter *known = pm_scene_words_parameter(plugin, name);
    if (known == NULL && is_scattering(plugin, name)) {
        PM_FAULT(source, given,
                 "%s \"%s\" has no parameter \"%s\": write sigma_t = sigma_s + sigma_a and "
                 "albedo = sigma_s / sigma_t",
                 plugin->tag, plugin->type, name);
    } else if (known == NULL) {
        const char *nearest = pm_scene_words_nearest_parameter(plugin, name);
        PM_FAULT(source, given, "%s \"%s\" has no parameter \"%.60s\"%s%s%s", plugin->tag,
                 plugin->type, name, nearest == NULL ? "" : "; the nearest is \"",
                 nearest == NULL ? "" : nearest, nearest == NULL ? "" : "\"");
    } else if ((known->kinds & pm_scene_words_kinds(given->tag)) == 0) {
        PM_FAULT(source, given, "%s %s must be %s, got <%s>", plugin->type, name,
                 pm_scene_words_spelling(known->kinds), given->tag);
    }
    for (const pm_xml *e = given->parent->child; e != given; e = e->next) {
        const char *other = pm_xml_attribute(e, "name");
        if (other != NULL && strcmp(other, name) == 0) {
            PM_FAULT(source, given, "%s %.60s is given twice, first at line %d", plugin->type,
                     name, e->line);
            return;
        }
    }
}

static void check_required(pm_scene_file *source, const pm_xml *object,
                           const pm_word_plugin *plugin)
{
    for (const pm_word_parameter *p = plugin->parameters; p->name != NULL; p++) {
        bool given = !p->required;
        for (const pm_xml *e = object->child; e != NULL && !given; e = e->next) {
            const char *name = pm_xml_attribute(e, "name");
            given = name != NULL && strcmp(name, p->name) == 0;
        }
        if (!given) {
            PM_FAULT(source, object, "%s \"%s\" needs the parameter \"%s\", %s", plugin->tag,
                     plugin->type, p->name, pm_scene_words_spelling(p->kinds));
        }
    }
}

/// Only glass that bends light can disperse it.
static void check_instruction(pm_scene_file *source, const pm_xml *instruction)
{
    const pm_xml *parent = instruction->parent;
    const char *type = pm_xml_attribute(parent, "type");
    if (strcmp(parent->tag, "bsdf") != 0 || type == NULL || strcmp(type, "dielectric") != 0) {
        PM_FAULT(source, instruction,
                 "<?photonlab ...?> names the glass of a dielectric bsdf and cannot stand "
                 "inside <%s%s%.40s>",
                 parent->tag, type == NULL ? "" : " type=", type == NULL ? "" : type);
    }
}

/// False when what stands inside `element` cannot be judged.
static bool check_element(pm_scene_file *source, const pm_xml *element)
{
    if (strcmp(element->tag, PM_XML_INSTRUCTION) == 0) {
        check_instruction(source, element);
        return false;
    }
    const pm_word_element *word = pm_scene_words_element(element->tag);
    if (word == NULL) {
        PM_FAULT(source, element, "<%.60s> is not supported; the nearest known element is <%s>",
                 element->tag, pm_scene_words_nearest_element(element->tag));
        return false;
    }
    if (element->parent != NULL && !pm_word_listed(element->parent->tag, word->inside, ' ')) {
        PM_FAULT(source, element, "<%s> cannot stand inside <%s>", element->tag,
                 element->parent->tag);
        return false;
    }
    check_attributes(source, element, word);
    return !pm_word_listed(element->tag, "integrator sampler rfilter", ' ');
}

static void check_tree(pm_scene_file *source, const pm_xml *element)
{
    if (!check_element(source, element)) {
        return;
    }
    const pm_word_plugin *plugin = check_type(source, element);
    if (plugin != NULL) {
        check_required(source, element, plugin);
    }
    for (const pm_xml *e = element->child; e != NULL; e = e->next) {
        if (plugin != NULL && pm_scene_words_kinds(e->tag) != 0) {
            check_parameter(source, e, plugin);
        }
        check_tree(source, e);
    }
}

void pm_scene_check_words(pm_scene_file *source)
{
    check_tree(source, source->root);
}
