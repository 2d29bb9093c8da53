// A scene file while it becomes a scene: its tree of elements, its ids, the scene so far, and
// the faults found so far. The parts of the reader hand this from one to the next.
//
// Invariant: a part that finds a fault reports it and goes on with some harmless value, so that
// one reading finds them all; the scene is handed out only when there was none.
#ifndef PM_SCENE_FILE_H
#define PM_SCENE_FILE_H

#include "arena.h"
#include "faults.h"
#include "scene.h"
#include "xml.h"

typedef struct {
    pm_arena tree;   // elements, gone after reading
    pm_arena *arena; // what the scene points to
    pm_faults faults;
    pm_xml *root;
    pm_xml **named; // elements with an id, sorted by it
    int named_count;
    pm_scene scene;
    int plain;             // material of shapes without a bsdf, or PM_NONE until there is one
    pm_vec3 *shape_origin; // per shape: where its data's origin lies in the file's coordinates
    pm_vec3 *light_origin; // per light, likewise
    pm_vec3 camera_origin;
} pm_scene_file;

/// A fault at `element`.
#define PM_FAULT(source, element, ...)                                                         \
    pm_faults_add(&(source)->faults, (element)->file, (element)->line, __VA_ARGS__)

/// pm_arena_take() from the scene's memory; NULL is recorded as a fault.
void *pm_scene_file_take(pm_scene_file *source, size_t count, size_t size);

/// How many elements of this tag there are.
int pm_scene_file_count(const pm_scene_file *source, const char *tag);

/// Finds every id, and numbers the objects that are called TYPE@LINE alike. Two objects of the
/// same id are a fault.
void pm_scene_file_collect_ids(pm_scene_file *source);

/// The object that <ref> means, or NULL.
pm_xml *pm_scene_file_find(const pm_scene_file *source, const pm_xml *ref);

/// The same; NULL after a fault.
pm_xml *pm_scene_file_resolve(pm_scene_file *source, const pm_xml *ref);

/// The object's id in the file, or TYPE@LINE, made unique by "#2" ... when several objects of
/// one type begin on lines of the same number. Lives as long as the scene.
const char *pm_scene_file_name(pm_scene_file *source, const pm_xml *object);

/// Adds a line about what is accepted but not used.
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void
pm_scene_file_note(pm_scene_file *source, const pm_xml *element, const char *format, ...);

#endif
