// The reader's steps: XML to a tree, the tree's words checked, parts built, the whole
// recentred.
//
// Invariant: `scene` is written only when no step found a fault.
#include "scene_read.h"

#include "scene_build.h"
#include "scene_center.h"
#include "scene_check.h"
#include "scene_hash.h"
#include "scene_stand.h"

#include <stdlib.h>
#include <string.h>

static void build(pm_scene_file *source, bool needs_camera)
{
    pm_scene_check_words(source);
    pm_scene_file_collect_ids(source);
    pm_scene_build_materials(source);
    if (source->faults.worst == PM_ENOMEM) {
        return;
    }
    pm_scene_build_media(source);
    pm_scene_build_shapes(source);
    pm_scene_build_lights(source);
    pm_scene_build_camera(source);
    if (needs_camera && !source->scene.has_camera) {
        pm_faults_add(&source->faults, source->root->file, 0,
                      "the scene has no sensor, and a picture needs one");
    }
}

static pm_status read_into(pm_scene_file *source, const char *path, const pm_define *defines,
                           int define_count, bool needs_camera)
{
    source->root = pm_xml_read(path, defines, define_count, &source->tree, &source->faults);
    source->scene.path = pm_arena_copy(source->arena, path, strlen(path));
    if (source->root != NULL && source->scene.path != NULL) {
        build(source, needs_camera);
    } else if (pm_faults_none(&source->faults)) {
        pm_faults_fail(&source->faults, PM_ENOMEM);
    }
    if (pm_faults_none(&source->faults)) {
        pm_scene_center(source);
        pm_scene_stand(source);
        source->scene.hash = pm_scene_hash(&source->scene);
    }
    return pm_faults_report(&source->faults);
}

pm_status pm_scene_read(const char *path, const pm_define *defines, int define_count,
                        bool needs_camera, pm_scene *scene)
{
    pm_scene_file *source = calloc(1, sizeof *source);
    pm_arena *arena = calloc(1, sizeof *arena);
    pm_status status = PM_ENOMEM;
    if (source != NULL && arena != NULL) {
        source->arena = arena;
        source->plain = PM_NONE;
        status = read_into(source, path, defines, define_count, needs_camera);
        pm_arena_free(&source->tree);
    } else {
        pm_status_fail(PM_ENOMEM, "%s: no memory to read the scene", path);
    }
    if (status == PM_OK) {
        *scene = source->scene;
        scene->storage = arena;
    } else if (arena != NULL) {
        pm_arena_free(arena);
        free(arena);
    }
    free(source);
    return status;
}

void pm_scene_free(pm_scene *scene)
{
    if (scene->storage != NULL) {
        pm_arena_free(scene->storage);
        free(scene->storage);
    }
    *scene = (pm_scene){0};
}
