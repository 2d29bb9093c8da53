// The camera, against rays that Mitsuba 3.9 shoots (in single precision).
#include "camera.h"
#include "scene_text.h"
#include "test.h"

#include <string.h>

static pm_scene read_sensor(const char *inside)
{
    pm_scene scene = {0};
    CHECK_OK(pm_scene_text_read(&scene, "<sensor type='perspective'>%s</sensor>", inside));
    CHECK(scene.has_camera);
    return scene;
}

static void check_ray(const pm_scene *scene, double u, double v, double x, double y, double z)
{
    pm_vec3 got = pm_camera_ray(&scene->camera, u, v).direction;
    CHECK_NEAR(got.x, x, 1e-6);
    CHECK_NEAR(got.y, y, 1e-6);
    CHECK_NEAR(got.z, z, 1e-6);
}

static void mirrored(void)
{
    const char *look = "<transform name='to_world'>"
                       "<lookat origin='1,2,3' target='4,6,3' up='0,0,1'/></transform>";
    const char *mirror = "<transform name='to_world'><scale x='-1' y='1' z='1'/>"
                         "<lookat origin='1,2,3' target='4,6,3' up='0,0,1'/></transform>";
    pm_scene plain = read_sensor(look);
    pm_scene swapped = read_sensor(mirror);
    check_ray(&plain, 0.0, 0.0, 0.29652864, 0.92482716, 0.23825508);
    check_ray(&plain, 1.0, 0.0, 0.80480611, 0.54361904, 0.23825508);
    check_ray(&swapped, 0.0, 0.0, 0.80480611, 0.54361904, 0.23825508);
    check_ray(&swapped, 1.0, 0.0, 0.29652864, 0.92482716, 0.23825508);
    check_ray(&swapped, 0.0, 1.0, 0.80480611, 0.54361904, -0.23825508);
    CHECK(plain.camera.width == 768 && plain.camera.height == 576);
    pm_vec3 at = pm_vec_add(plain.camera.position, plain.center);
    CHECK_NEAR(at.x + 10.0 * at.y + 100.0 * at.z, 321.0, 1e-12);
    pm_scene_free(&plain);
    pm_scene_free(&swapped);
}

static void check_axis(const char *axis, int width, int height, double x, double y, double z)
{
    pm_scene scene = {0};
    CHECK_OK(pm_scene_text_read(
        &scene,
        "<sensor type='perspective'><float name='fov' value='60'/>"
        "<string name='fov_axis' value='%s'/><film type='hdrfilm'>"
        "<integer name='width' value='%d'/><integer name='height' value='%d'/></film></sensor>",
        axis, width, height));
    check_ray(&scene, 0.0, 0.0, x, y, z);
    pm_scene_free(&scene);
}

static void axes(void)
{
    check_axis("x", 200, 100, 0.48507127, 0.24253563, 0.84016812);
    check_axis("y", 200, 100, 0.70710677, 0.35355335, 0.61237240);
    check_axis("diagonal", 200, 100, 0.44721359, 0.22360681, 0.86602539);
    check_axis("smaller", 200, 100, 0.70710677, 0.35355335, 0.61237240);
    check_axis("larger", 200, 100, 0.48507127, 0.24253563, 0.84016812);
    check_axis("x", 100, 150, 0.40000000, 0.60000002, 0.69282037);
    check_axis("y", 100, 150, 0.31622779, 0.47434169, 0.82158387);
    check_axis("diagonal", 100, 150, 0.27735010, 0.41602516, 0.86602545);
    check_axis("smaller", 100, 150, 0.40000000, 0.60000002, 0.69282037);
    check_axis("larger", 100, 150, 0.31622779, 0.47434169, 0.82158387);
}

static void red_on_the_left(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_read("scenes/cornell-spheres.xml", NULL, 0, true, &s));
    // What Mitsuba 3.9 sees at these points of the film.
    static const struct {
        double u, v;
        const char *shape;
    } seen[4] = {{0.05, 0.5, "red-wall"},
                 {0.95, 0.5, "green-wall"},
                 {0.3, 0.8, "mirror-sphere"},
                 {0.7, 0.8, "glass-sphere"}};
    for (int i = 0; i < 4; i++) {
        pm_ray ray = pm_camera_ray(&s.camera, seen[i].u, seen[i].v);
        int shape = pm_scene_text_first(&s, &ray);
        CHECK_THAT(strcmp(s.shapes[shape].id, seen[i].shape) == 0, "(%g, %g) shows %s, not %s",
                   seen[i].u, seen[i].v, s.shapes[shape].id, seen[i].shape);
    }
    pm_scene_free(&s);
}

static void unused(void)
{
    pm_scene s =
        read_sensor("<float name='near_clip' value='0.1'/><float name='far_clip' value='9'/>"
                    "<sampler type='independent'><integer name='x' value='1'/></sampler>"
                    "<film type='hdrfilm'><rfilter type='gaussian'/></film>");
    static const char *const parts[4] = {"sampler", "near_clip", "far_clip", "rfilter"};
    CHECK(s.note_count == 4);
    for (int i = 0; i < 4; i++) {
        int found = 0;
        for (int n = 0; n < s.note_count; n++) {
            found += strstr(s.notes[n], parts[i]) != NULL;
        }
        CHECK_THAT(found == 1, "%s is noted %d times", parts[i], found);
    }
    pm_scene_free(&s);
}

PM_TESTS({"scene_camera.1", "the camera looks as Mitsuba's, mirrored or not", mirrored},
         {"scene_camera.2", "the field of view runs along the axis asked for", axes},
         {"scene_camera.3", "the red wall is on the left", red_on_the_left},
         {"scene_camera.4", "what is accepted but not used is noted", unused})
