// Contracts are in the header.
#include "scene_text.h"

#include "intersect_plain.h"
#include "test.h"

#include <stdarg.h>
#include <stdio.h>

const char *pm_scene_text_write(const char *name, const char *text)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", pm_test_folder(), name);
    FILE *stream = fopen(path, "w");
    CHECK(stream != NULL);
    fputs(text, stream);
    CHECK(fclose(stream) == 0);
    return path;
}

pm_status pm_scene_text_read(pm_scene *scene, const char *format, ...)
{
    char body[8192];
    char text[8400];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(body, sizeof body, format, arguments);
    va_end(arguments);
    CHECK(length > 0 && length < (int)sizeof body);
    snprintf(text, sizeof text,
             "<scene version=\"3.0.0\">\n%s\n<emitter type=\"point\"/></scene>", body);
    return pm_scene_read(pm_scene_text_write("scene.xml", text), NULL, 0, false, scene);
}

static pm_hit meet(const pm_scene *scene, const pm_ray *ray)
{
    pm_intersector world;
    pm_hit hit;
    CHECK_OK(pm_intersect_plain(scene, &world));
    CHECK_THAT(pm_closest(&world, ray, &hit), "the ray meets nothing");
    pm_intersector_free(&world);
    return hit;
}

int pm_scene_text_first(const pm_scene *scene, const pm_ray *ray)
{
    return meet(scene, ray).shape;
}

pm_vec3 pm_scene_text_normal(const pm_scene *scene, pm_vec3 origin, pm_vec3 direction)
{
    pm_ray ray = {pm_vec_sub(origin, scene->center), direction, HUGE_VAL, 0.0, PM_NONE};
    return meet(scene, &ray).normal;
}
