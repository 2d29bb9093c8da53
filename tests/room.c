// Nothing stands in the middle of the room.
#include "room.h"

#include "balance.h"
#include "command.h"
#include "photon_file.h"
#include "photon_map.h"
#include "scene_read.h"
#include "store.h"

static const char scene_text[] =
    "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>"
    "<transform name=\"to_world\"><lookat origin=\"5,5,8\" target=\"5,5,5\" up=\"0,1,0\"/>"
    "</transform></sensor>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/>"
    "<translate x=\"5\" y=\"5\" z=\"4.5\"/></transform></shape>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/>"
    "<rotate x=\"1\" angle=\"-90\"/><translate x=\"5\" y=\"4.5\" z=\"5\"/></transform></shape>"
    "<emitter type=\"point\"><point name=\"position\" x=\"5\" y=\"5.5\" z=\"5.5\"/>"
    "<rgb name=\"intensity\" value=\"1, 1, 1\"/></emitter></scene>";

const char *pm_room_scene(void)
{
    return pm_command_write("scene.xml", scene_text);
}

const char *pm_room_map(const char *name, const pm_vec3 *places, int count, pm_spectrum power,
                        bool balanced)
{
    pm_scene scene;
    CHECK_OK(pm_scene_read(pm_room_scene(), NULL, 0, false, &scene));
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    for (int i = 0; i < count; i++) {
        pm_deposit deposit = {.position = pm_vec_sub(places[i], scene.center),
                              .direction = pm_vec(0.0, 0.0, -1.0),
                              .normal = pm_vec(0.0, 0.0, 1.0),
                              .power = power};
        CHECK_OK(pm_store_push(&map, &deposit));
    }
    CHECK_OK(pm_store_scale(&map, 1234));
    if (balanced) {
        CHECK_OK(pm_balance_build(&map));
    }
    pm_photon_file_info info = {.scene_hash = scene.hash, .center = scene.center};
    const char *path = pm_command_path(name);
    CHECK_OK(pm_photon_file_write(path, &map, &info, NULL));
    pm_photon_map_free(&map);
    pm_scene_free(&scene);
    return path;
}
