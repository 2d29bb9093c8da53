// Recentring: far away, scaled, and what the hash depends on.
#include "scene_text.h"
#include "test.h"

#define PLACE "<translate value='$move'/><scale value='$grow'/></transform>"

/// One of each kind; every transform ends alike, by -D.
static const char text[] =
    "<scene version='3.0.0'>"
    "<default name='move' value='0 0 0'/><default name='grow' value='1'/>"
    "<default name='albedo' value='0.5'/><default name='id' value='a'/>"
    "<default name='fov' value='40'/><default name='lamp' value='4.4'/><default name='beam' "
    "value='11'/><default name='spare' "
    "value='0.1'/>"
    "<sensor type='perspective'><float name='fov' value='$fov'/>"
    "<transform name='to_world'><translate value='$move'/></transform></sensor>"
    "<bsdf type='diffuse'><float name='reflectance' value='$spare'/></bsdf>"
    "<shape type='rectangle' id='$id'><transform name='to_world'><scale x='1.7' y='0.3'/>"
    "<rotate x='0.6' y='0.8' angle='31'/>" PLACE "</shape>"
    "<shape type='cube'><transform name='to_world'><rotate z='1' angle='12'/>"
    "<translate x='3.1'/>" PLACE "<emitter type='area'/><bsdf type='diffuse'>"
    "<float name='reflectance' value='$albedo'/></bsdf></shape>"
    "<shape type='sphere'><point name='center' value='-2.2 1.3 0.7'/>"
    "<float name='radius' value='0.37'/><transform name='to_world'>" PLACE "</shape>"
    "<shape type='disk'><transform name='to_world'><scale value='0.9'/><rotate y='1' "
    "angle='55'/>"
    "<translate y='-2.3'/>" PLACE "</shape>"
    "<shape type='cylinder'><point name='p0' value='0.1 0.2 0.3'/>"
    "<point name='p1' value='1.1 0.4 2.3'/><float name='radius' value='0.21'/>"
    "<transform name='to_world'>" PLACE "</shape>"
    "<emitter type='point'><transform name='to_world'><translate z='$lamp'/>" PLACE
    "</emitter><emitter type='spot'><float name='beam_width' value='$beam'/>"
    "<transform name='to_world'><translate x='0.5' z='1'/>" PLACE "</emitter></scene>";

/// The scene with one of its defaults changed.
static pm_scene read_with(const char *name, const char *value)
{
    pm_scene scene = {0};
    pm_define define = {name, value};
    CHECK_OK(pm_scene_read(pm_scene_text_write("one.xml", text), &define, 1, true, &scene));
    CHECK(scene.shape_count == 5 && scene.light_count == 3);
    return scene;
}

static void check_vectors(pm_vec3 got, pm_vec3 want, double factor, double tolerance)
{
    CHECK_NEAR(got.x, factor * want.x, tolerance);
    CHECK_NEAR(got.y, factor * want.y, tolerance);
    CHECK_NEAR(got.z, factor * want.z, tolerance);
}

static void check_shape(const pm_shape *got, const pm_shape *want, double factor,
                        double tolerance)
{
    check_vectors(got->corner, want->corner, factor, tolerance);
    check_vectors(got->edge[0], want->edge[0], factor, 0.0);
    check_vectors(got->edge[1], want->edge[1], factor, 0.0);
    check_vectors(got->center, want->center, factor, tolerance);
    check_vectors(got->axis, want->axis, 1.0, 0.0);
    CHECK_NEAR(got->radius, factor * want->radius, 0.0);
    CHECK_NEAR(got->length, factor * want->length, 0.0);
    CHECK_NEAR(got->area, factor * factor * want->area, 0.0);
    CHECK_NEAR(got->reach, factor * want->reach, tolerance);
    for (uint32_t i = 0; i < want->vertex_count; i++) {
        check_vectors(got->vertices[i], want->vertices[i], factor, tolerance);
    }
}

static void check_scenes(const pm_scene *got, const pm_scene *want, double factor,
                         double tolerance)
{
    for (int i = 0; i < want->shape_count; i++) {
        check_shape(&got->shapes[i], &want->shapes[i], factor, tolerance);
    }
    check_vectors(got->lights[1].position, want->lights[1].position, factor, tolerance);
    check_vectors(got->lights[2].position, want->lights[2].position, factor, tolerance);
    check_vectors(got->low, want->low, factor, tolerance);
    check_vectors(got->high, want->high, factor, tolerance);
    CHECK_NEAR(got->radius, factor * want->radius, tolerance);
    CHECK_NEAR(got->lights[0].flux.c[0], factor * factor * want->lights[0].flux.c[0], 0.0);
}

static void centred(void)
{
    pm_scene s = read_with("grow", "1");
    // x from the sphere's -2.57 to the cube's turned corner, y of the disk's rim up to the
    // sphere, z from the cube to the cylinder's far rim. The light stands above all of it.
    double corner = 3.1 + cos(12.0 * PM_PI / 180.0) + sin(12.0 * PM_PI / 180.0);
    double rim = 2.3 + 0.21 * sqrt(1.0 - 4.0 / 5.04);
    pm_vec3 middle = pm_vec((corner - 2.57) / 2.0, (-3.2 + 1.67) / 2.0, (rim - 1.0) / 2.0);
    check_vectors(s.center, middle, 1.0, 1e-14);
    check_vectors(s.low, pm_vec(-2.57 - middle.x, -3.2 - middle.y, -1.0 - middle.z), 1.0,
                  1e-14);
    check_vectors(s.high, pm_vec(-s.low.x, -s.low.y, 4.4 - middle.z), 1.0, 1e-14);
    CHECK_NEAR(s.radius, pm_vec_length(s.high), 1e-14);
    check_vectors(s.camera.position, s.center, -1.0, 0.0);
    for (int i = 0; i < s.shape_count; i++) {
        CHECK(s.shapes[i].reach <= pm_vec_reach(s.high) * (1.0 + 1e-15));
    }
    pm_scene_free(&s);
}

// Photons are stored as floats and offsets grow with coordinates.
static void far_lamp(void)
{
    pm_scene near = read_with("lamp", "4.4");
    pm_scene far = read_with("lamp", "1e9");
    check_vectors(far.center, near.center, 1.0, 0.0);
    for (int i = 0; i < near.shape_count; i++) {
        check_shape(&far.shapes[i], &near.shapes[i], 1.0, 0.0);
    }
    CHECK_NEAR(far.lights[1].position.z, 1e9 - far.center.z, 1e-6);
    CHECK(far.radius >= 1e9 - far.center.z);
    pm_scene_free(&near);
    pm_scene_free(&far);
}

static void far_away(void)
{
    // A million times its size away: what remains is the rounding of the coordinates in the
    // file, a few times 2^-53 of 1.1e7.
    pm_scene here = read_with("move", "0 0 0");
    pm_scene there = read_with("move", "5e6 -7e6 1.1e7");
    check_scenes(&there, &here, 1.0, 4.0 * 0x1p-53 * 1.1e7);
    check_vectors(there.camera.position, here.camera.position, 1.0, 4.0 * 0x1p-53 * 1.1e7);
    check_vectors(pm_vec_sub(there.center, here.center), pm_vec(5e6, -7e6, 1.1e7), 1.0, 1e-8);
    pm_scene_free(&here);
    pm_scene_free(&there);
}

static void scaled(void)
{
    pm_scene here = read_with("grow", "1");
    pm_scene small = read_with("grow", "0.0009765625");
    pm_scene large = read_with("grow", "1048576");
    check_scenes(&small, &here, 0x1p-10, 0.0);
    check_scenes(&large, &here, 0x1p20, 0.0);
    pm_scene_free(&here);
    pm_scene_free(&small);
    pm_scene_free(&large);
}

static void single_point(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s, "<!-- only the light -->"));
    CHECK(s.shape_count == 0 && s.radius == 1.0);
    pm_scene_free(&s);
}

static void check_hash(const char *name, const char *value, bool same)
{
    pm_scene plain = read_with("grow", "1");
    pm_scene other = read_with(name, value);
    CHECK_THAT((plain.hash == other.hash) == same, "%s=%s: hash %llx, before %llx", name, value,
               (unsigned long long)other.hash, (unsigned long long)plain.hash);
    pm_scene_free(&plain);
    pm_scene_free(&other);
}

static void hash(void)
{
    check_hash("id", "b", true);
    check_hash("fov", "41", true);
    check_hash("spare", "0.2", true);
    check_hash("grow", "1.0000000000000003", false);
    check_hash("move", "1 0 0", false);
    check_hash("beam", "11.000000000000002", false);
    check_hash("albedo", "0.50000000000000012", false);
}

PM_TESTS({"scene_center.1", "the scene's middle comes to lie in the origin", centred},
         {"scene_center.2", "a scene a million sizes away is the same to rounding", far_away},
         {"scene_center.3", "a scene scaled by a power of two is scaled exactly", scaled},
         {"scene_center.4", "a scene that is one point has a radius", single_point},
         {"scene_center.5", "the hash depends on what light depends on, to the last bit", hash},
         {"scene_center.6", "a lamp far away does not move the shapes from the origin",
          far_lamp})
