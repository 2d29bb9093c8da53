// Contracts are in the header.
#include "scene_file.h"

#include "nearest.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *pm_scene_file_take(pm_scene_file *source, size_t count, size_t size)
{
    void *piece = pm_arena_take(source->arena, count, size);
    if (piece == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
    }
    return piece;
}

int pm_scene_file_count(const pm_scene_file *source, const char *tag)
{
    int count = 0;
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        count += strcmp(e->tag, tag) == 0;
    }
    return count;
}

static const char *id_of(const pm_xml *element)
{
    return strcmp(element->tag, "ref") == 0 ? NULL : pm_xml_attribute(element, "id");
}

static int by_id(const void *a, const void *b)
{
    const pm_xml *const *first = a;
    const pm_xml *const *second = b;
    return strcmp(id_of(*first), id_of(*second));
}

static void gather_named(pm_scene_file *source)
{
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        if (id_of(e) == NULL || id_of(e) == pm_xml_faulty) {
            continue;
        }
        if (source->named != NULL) {
            source->named[source->named_count] = e;
        }
        source->named_count++;
    }
}

static bool is_nameless(const pm_xml *element)
{
    return id_of(element) == NULL && pm_xml_attribute(element, "type") != NULL;
}

/// By type, line and place in the document, which stands in `index` meanwhile.
static int by_type_and_line(const void *a, const void *b)
{
    const pm_xml *const *first = a;
    const pm_xml *const *second = b;
    int type = strcmp(pm_xml_attribute(*first, "type"), pm_xml_attribute(*second, "type"));
    if (type != 0) {
        return type;
    }
    int line = ((*first)->line > (*second)->line) - ((*first)->line < (*second)->line);
    return line != 0 ? line : (*first)->index - (*second)->index;
}

/// Numbers the objects that would be called alike.
static void number_twins(pm_xml **objects, int count)
{
    qsort(objects, (size_t)count, sizeof *objects, by_type_and_line);
    for (int i = 1; i < count; i++) {
        const pm_xml *before = objects[i - 1];
        bool alike =
            objects[i]->line == before->line &&
            strcmp(pm_xml_attribute(objects[i], "type"), pm_xml_attribute(before, "type")) == 0;
        objects[i]->twin = alike ? before->twin + 1 : 0;
    }
    for (int i = 0; i < count; i++) {
        objects[i]->index = PM_NONE;
    }
}

static void find_twins(pm_scene_file *source)
{
    int count = 0;
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        count += is_nameless(e);
    }
    pm_xml **objects = pm_arena_take(&source->tree, (size_t)count, sizeof(pm_xml *));
    if (objects == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    count = 0;
    for (pm_xml *e = source->root; e != NULL; e = pm_xml_following(source->root, e)) {
        if (is_nameless(e)) {
            e->index = count;
            objects[count++] = e;
        }
    }
    number_twins(objects, count);
}

void pm_scene_file_collect_ids(pm_scene_file *source)
{
    find_twins(source);
    gather_named(source);
    source->named = pm_arena_take(&source->tree, (size_t)source->named_count, sizeof(pm_xml *));
    source->named_count = 0;
    if (source->named == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    gather_named(source);
    qsort(source->named, (size_t)source->named_count, sizeof(pm_xml *), by_id);
    for (int i = 1; i < source->named_count; i++) {
        const pm_xml *a = source->named[i - 1];
        const pm_xml *b = source->named[i];
        if (by_id(&a, &b) == 0) {
            PM_FAULT(source, b, "id \"%.60s\" is given twice, also at %.120s:%d", id_of(b),
                     a->file, a->line);
        }
    }
}

static void report_unknown_id(pm_scene_file *source, const pm_xml *ref, const char *id)
{
    const char *nearest = NULL;
    for (int i = 0; i < source->named_count; i++) {
        const char *pair[2] = {id_of(source->named[i]), nearest};
        nearest = pm_nearest_word(id, pair, nearest == NULL ? 1 : 2);
    }
    if (nearest == NULL) {
        PM_FAULT(source, ref, "ref id \"%.60s\" is not defined; no object has an id", id);
    } else {
        PM_FAULT(source, ref,
                 "ref id \"%.60s\" is not defined; the nearest known id is \"%.60s\"", id,
                 nearest);
    }
}

pm_xml *pm_scene_file_find(const pm_scene_file *source, const pm_xml *ref)
{
    const char *id = pm_xml_attribute(ref, "id");
    if (id == NULL || id == pm_xml_faulty) {
        return NULL;
    }
    int low = 0;
    int high = source->named_count;
    while (low < high) {
        int middle = (low + high) / 2;
        int order = strcmp(id_of(source->named[middle]), id);
        if (order == 0) {
            return source->named[middle];
        }
        low = order < 0 ? middle + 1 : low;
        high = order < 0 ? high : middle;
    }
    return NULL;
}

pm_xml *pm_scene_file_resolve(pm_scene_file *source, const pm_xml *ref)
{
    const char *id = pm_xml_attribute(ref, "id");
    pm_xml *meant = pm_scene_file_find(source, ref);
    if (meant == NULL && id != NULL && id != pm_xml_faulty) {
        report_unknown_id(source, ref, id);
    }
    return meant;
}

const char *pm_scene_file_name(pm_scene_file *source, const pm_xml *object)
{
    const char *id = id_of(object);
    const char *given = pm_xml_attribute(object, "type");
    const char *type = given == NULL ? object->tag : given;
    char *name;
    if (id != NULL) {
        name = pm_arena_copy(source->arena, id, strlen(id));
    } else {
        name = object->twin == 0 ? pm_arena_print(source->arena, "%s@%d", type, object->line)
                                 : pm_arena_print(source->arena, "%s@%d#%d", type, object->line,
                                                  object->twin + 1);
    }
    if (name == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return "";
    }
    return name;
}

void pm_scene_file_note(pm_scene_file *source, const pm_xml *element, const char *format, ...)
{
    char text[PM_FAULTS_LINE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    pm_scene *scene = &source->scene;
    char **notes = pm_scene_file_take(source, (size_t)scene->note_count + 1, sizeof *notes);
    char *note = pm_arena_print(source->arena, "%s:%d: %s", element->file, element->line, text);
    if (notes == NULL || note == NULL) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
        return;
    }
    for (int i = 0; i < scene->note_count; i++) {
        notes[i] = scene->notes[i];
    }
    notes[scene->note_count++] = note;
    scene->notes = notes;
}
