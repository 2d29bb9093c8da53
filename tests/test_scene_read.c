// What the reader makes of shapes, materials and lights, value by value.
#include "scene_text.h"
#include "test.h"

#include <string.h>

#define FACES "<boolean name='face_normals' value='true'/>"
#define FLIP "<boolean name='flip_normals' value='true'/>"

static void check_vector(pm_vec3 got, double x, double y, double z)
{
    CHECK_NEAR(got.x, x, 1e-14);
    CHECK_NEAR(got.y, y, 1e-14);
    CHECK_NEAR(got.z, z, 1e-14);
}

static void check_spectrum(pm_spectrum got, double r, double g, double b)
{
    CHECK_NEAR(got.c[0], r, 1e-13 * fabs(r));
    CHECK_NEAR(got.c[1], g, 1e-13 * fabs(g));
    CHECK_NEAR(got.c[2], b, 1e-13 * fabs(b));
}

static void plain_shapes(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s, "<shape type='rectangle'/><shape type='cube'/>"
                                    "<shape type='sphere'/><shape type='disk'/>"
                                    "<shape type='cylinder'/>"));
    static const double areas[5] = {4.0, 24.0, 4.0 * PM_PI, PM_PI, 2.0 * PM_PI};
    CHECK(s.shape_count == 5);
    for (int i = 0; i < 5; i++) {
        CHECK_NEAR(s.shapes[i].area, areas[i], 1e-14);
        CHECK(!s.shapes[i].flipped && s.shapes[i].light == PM_NONE);
        CHECK_NEAR(s.shapes[i].reach, 1.0, 1e-15);
    }
    check_vector(s.shapes[0].corner, -1.0, -1.0, 0.0);
    check_vector(pm_vec_cross(s.shapes[0].edge[0], s.shapes[0].edge[1]), 0.0, 0.0, 4.0);
    CHECK(s.shapes[1].triangle_count == 12 && s.shapes[1].area_below == NULL);
    check_vector(s.shapes[3].axis, 0.0, 0.0, 1.0);
    check_vector(s.shapes[4].axis, 0.0, 0.0, 1.0);
    CHECK_NEAR(s.shapes[4].length, 1.0, 0.0);
    pm_scene_free(&s);
}

static void placed_shapes(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s, "<shape type='sphere'><point name='center' x='1' y='0' z='0'/>"
            "<float name='radius' value='0.5'/><transform name='to_world'>"
            "<rotate z='1' angle='90'/><scale value='2'/></transform></shape>"
            "<shape type='cylinder'><point name='p0' value='1 0 0'/>"
            "<point name='p1' value='1, 3, 0'/><float name='radius' value='0.5'/>"
            "<transform name='to_world'><scale x='2' y='5' z='2'/></transform></shape>"));
    pm_vec3 center = pm_vec_add(s.shapes[0].center, s.center);
    check_vector(center, 0.0, 2.0, 0.0);
    CHECK_NEAR(s.shapes[0].radius, 1.0, 0.0);
    check_vector(pm_vec_add(s.shapes[1].center, s.center), 2.0, 0.0, 0.0);
    check_vector(s.shapes[1].axis, 0.0, 1.0, 0.0);
    CHECK_NEAR(s.shapes[1].length, 15.0, 0.0);
    CHECK_NEAR(s.shapes[1].radius, 1.0, 1e-15);
    pm_scene_free(&s);
}

/// The side of the shape that faces up, seen from above at (0.1, 0.2), as Mitsuba 3.9 has it:
/// where the bsdf's front and the emission are.
static void check_side(const char *type, const char *scale, const char *extra, double want)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s,
        "<shape type='%s'>%s<transform name='to_world'><scale value='%s'/></transform></shape>",
        type, extra, scale));
    double got = pm_scene_text_normal(&s, pm_vec(0.1, 0.2, 9.0), pm_vec(0.0, 0.0, -1.0)).z;
    CHECK_THAT(got * want > 0.0, "%s scaled by %s %s faces %g, in Mitsuba %g", type, scale,
               extra, got, want);
    pm_scene_free(&s);
}

static void mirrored_sides(void)
{
    static const char *const scale[4] = {"1 1 1", "-1 1 1", "1 1 -1", "-1 -1 -1"};
    static const struct {
        const char *type;
        double side[4];
    } mitsuba[4] = {{"rectangle", {1, 1, -1, -1}},
                    {"disk", {1, 1, -1, -1}},
                    {"sphere", {1, -1, -1, -1}},
                    {"cube", {1, 1, 1, 1}}};
    for (int t = 0; t < 4; t++) {
        for (int i = 0; i < 4; i++) {
            check_side(mitsuba[t].type, scale[i], "", mitsuba[t].side[i]);
            check_side(mitsuba[t].type, scale[i], FLIP, -mitsuba[t].side[i]);
        }
    }
}

static void mirrored_meshes(void)
{
    const char *path = pm_scene_text_write(
        "t.obj",
        "v -5 -5 0\nv 5 -5 0\nv 0 5 0\nf 1 2 3\n# padding so that it is long enough\n");
    CHECK(strrchr(path, '/') != NULL);
    check_side("obj", "1 1 1", "<string name='filename' value='t.obj'/>" FACES, 1.0);
    check_side("obj", "1 1 1", "<string name='filename' value='t.obj'/>" FACES FLIP, -1.0);
    check_side("obj", "-1 1 1", "<string name='filename' value='t.obj'/>" FACES, -1.0);
}

static void materials(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s, "<bsdf type='diffuse' id='a'><rgb name='reflectance' value='0.1 0.2 0.3'/></bsdf>"
            "<bsdf type='dielectric' id='b'><string name='int_ior' value='Water'/></bsdf>"
            "<bsdf type='dielectric' id='c'/>"
            "<bsdf type='conductor' id='d'/>"
            "<bsdf type='conductor' id='e'><rgb name='eta' value='0.2 0.9 1.1'/>"
            "<float name='k' value='3'/><float name='specular_reflectance' value='0.5'/></bsdf>"
            "<bsdf type='null' id='f'/>"));
    CHECK(s.material_count == 6);
    const pm_material *m = s.materials;
    CHECK(m[0].type == PM_BSDF_DIFFUSE && strcmp(m[0].id, "a") == 0);
    check_spectrum(m[0].reflectance, 0.1, 0.2, 0.3);
    CHECK_NEAR(m[1].int_ior, 1.333, 0.0);
    CHECK_NEAR(m[2].int_ior, 1.5046, 0.0);
    CHECK_NEAR(m[2].ext_ior, 1.000277, 0.0);
    check_spectrum(m[2].specular_transmittance, 1.0, 1.0, 1.0);
    CHECK(m[3].perfect_mirror && !m[4].perfect_mirror);
    check_spectrum(m[3].specular_reflectance, 1.0, 1.0, 1.0);
    check_spectrum(m[4].eta, 0.2, 0.9, 1.1);
    check_spectrum(m[4].k, 3.0, 3.0, 3.0);
    check_spectrum(m[4].specular_reflectance, 0.5, 0.5, 0.5);
    CHECK(m[5].type == PM_BSDF_NULL);
    pm_scene_free(&s);
}

static void coated_materials(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s, "<bsdf type='thindielectric' id='a'/>"
            "<bsdf type='plastic' id='b'/>"
            "<bsdf type='plastic' id='c'><string name='int_ior' value='water'/>"
            "<float name='ext_ior' value='1.1'/>"
            "<rgb name='diffuse_reflectance' value='0.1 0.2 0.3'/>"
            "<float name='specular_reflectance' value='0.25'/></bsdf>"
            "<bsdf type='roughplastic' id='d'/>"
            "<bsdf type='roughplastic' id='e'><string name='distribution' value='ggx'/>"
            "<float name='alpha' value='0.3'/></bsdf>"));
    CHECK(s.material_count == 5);
    const pm_material *m = s.materials;
    CHECK(m[0].type == PM_BSDF_THIN_DIELECTRIC);
    CHECK_NEAR(m[0].int_ior, 1.5046, 0.0);
    check_spectrum(m[0].specular_transmittance, 1.0, 1.0, 1.0);
    CHECK(m[1].type == PM_BSDF_PLASTIC);
    CHECK_NEAR(m[1].int_ior, 1.49, 0.0);
    CHECK_NEAR(m[1].ext_ior, 1.000277, 0.0);
    check_spectrum(m[1].reflectance, 0.5, 0.5, 0.5);
    check_spectrum(m[1].specular_reflectance, 1.0, 1.0, 1.0);
    CHECK(m[1].coat_mean > 0.9 && m[1].coat_inside > 0.5); // prepared
    CHECK_NEAR(m[2].int_ior, 1.333, 0.0);
    CHECK_NEAR(m[2].ext_ior, 1.1, 0.0);
    check_spectrum(m[2].reflectance, 0.1, 0.2, 0.3);
    check_spectrum(m[2].specular_reflectance, 0.25, 0.25, 0.25);
    CHECK(m[3].type == PM_BSDF_ROUGH_PLASTIC && m[3].microfacet == PM_MICROFACET_BECKMANN);
    CHECK_NEAR(m[3].alpha, 0.1, 0.0);
    CHECK(m[3].coat[PM_COSINE_TABLE - 1] > 0.9);
    CHECK(m[4].microfacet == PM_MICROFACET_GGX);
    CHECK_NEAR(m[4].alpha, 0.3, 0.0);
    pm_scene_free(&s);
}

static void rough_metals(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s, "<bsdf type='roughconductor' id='a'/>"
            "<bsdf type='roughconductor' id='b'><string name='distribution' value='ggx'/>"
            "<float name='alpha' value='0.0001'/><rgb name='eta' value='0.2 0.9 1.1'/>"
            "<float name='k' value='3'/><float name='specular_reflectance' value='0.5'/></bsdf>"
            "<bsdf type='roughconductor'><string name='material' value='none'/></bsdf>"));
    const pm_material *m = s.materials;
    CHECK(m[0].type == PM_BSDF_ROUGH_CONDUCTOR && m[0].perfect_mirror);
    CHECK(m[0].microfacet == PM_MICROFACET_BECKMANN);
    CHECK_NEAR(m[0].alpha, 0.1, 0.0);
    check_spectrum(m[0].specular_reflectance, 1.0, 1.0, 1.0);
    CHECK(!m[1].perfect_mirror && m[1].microfacet == PM_MICROFACET_GGX);
    CHECK_NEAR(m[1].alpha, 1e-4, 0.0);
    check_spectrum(m[1].eta, 0.2, 0.9, 1.1);
    check_spectrum(m[1].k, 3.0, 3.0, 3.0);
    check_spectrum(m[1].specular_reflectance, 0.5, 0.5, 0.5);
    CHECK(m[2].perfect_mirror);
    pm_scene_free(&s);
}

static uint64_t hash_of(const char *bsdf)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s, "<shape type='sphere'>%s</shape>", bsdf));
    uint64_t hash = s.hash;
    pm_scene_free(&s);
    return hash;
}

static void roughness_is_hashed(void)
{
    uint64_t plain = hash_of("<bsdf type='roughconductor'/>");
    CHECK(hash_of("<bsdf type='roughconductor'><float name='alpha' value='0.1'/></bsdf>") ==
          plain);
    CHECK(hash_of("<bsdf type='roughconductor'><float name='alpha' value='0.11'/></bsdf>") !=
          plain);
    CHECK(hash_of("<bsdf type='roughconductor'><string name='distribution' value='ggx'/>"
                  "</bsdf>") != plain);
    CHECK(hash_of("<bsdf type='conductor'/>") != plain);
}

static void check_sides(const pm_scene *s, int shape, int front, int back)
{
    CHECK_THAT(s->shapes[shape].material[0] == front && s->shapes[shape].material[1] == back,
               "shape %d has materials %d and %d", shape, s->shapes[shape].material[0],
               s->shapes[shape].material[1]);
}

static void sides(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s,
        "<shape type='sphere'><ref id='later'/></shape>"
        "<shape type='sphere'><bsdf type='dielectric'/></shape>"
        "<shape type='sphere'><bsdf type='null'/></shape>"
        "<shape type='sphere'><bsdf type='twosided'><bsdf type='conductor'/></bsdf></shape>"
        "<shape type='sphere'><ref id='pair'/></shape>"
        "<shape type='sphere'/>"
        "<shape type='sphere'/>"
        "<bsdf type='twosided' id='pair'><ref id='later'/><bsdf type='diffuse'/></bsdf>"
        "<bsdf type='diffuse' id='later'/>"
        "<shape type='sphere'><bsdf type='thindielectric'/></shape>"
        "<shape type='sphere'><bsdf type='roughplastic'/></shape>"
        "<shape type='sphere'><bsdf type='twosided'><bsdf type='plastic'/></bsdf></shape>"));
    CHECK(s.material_count == 9);
    check_sides(&s, 0, 4, PM_NONE);
    check_sides(&s, 1, 0, 0);
    check_sides(&s, 2, 1, 1);
    check_sides(&s, 3, 2, 2);
    check_sides(&s, 4, 4, 3);
    check_sides(&s, 5, 8, PM_NONE);
    check_sides(&s, 6, 8, PM_NONE);
    check_sides(&s, 7, 5, 5);
    check_sides(&s, 8, 6, PM_NONE);
    check_sides(&s, 9, 7, 7);
    check_spectrum(s.materials[8].reflectance, 0.5, 0.5, 0.5);
    pm_scene_free(&s);
}

static void lights(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s,
        "<emitter type='point' id='p'><transform name='to_world'><translate x='2'/>"
        "<rotate z='1' angle='90'/></transform><rgb name='intensity' value='1 2 3'/></emitter>"
        "<emitter type='directional'><vector name='direction' x='0' y='3' z='4'/></emitter>"
        "<emitter type='directional'><transform name='to_world'><scale z='-2'/></transform>"
        "<float name='irradiance' value='2'/></emitter>"
        "<shape type='disk'><emitter type='area' id='e'>"
        "<rgb name='radiance' value='5'/></emitter></shape>"
        "<shape type='cube'><emitter type='area'/></shape>"));
    CHECK(s.light_count == 6);
    const pm_light *l = s.lights;
    check_vector(pm_vec_add(l[0].position, s.center), 0.0, 2.0, 0.0);
    check_spectrum(l[0].flux, 4.0 * PM_PI, 8.0 * PM_PI, 12.0 * PM_PI);
    check_vector(l[1].direction, 0.0, 0.6, 0.8);
    check_vector(l[2].direction, 0.0, 0.0, -1.0);
    CHECK_NEAR(l[2].flux.c[1], 2.0 * PM_PI * s.radius * s.radius, 1e-12);
    CHECK(l[3].type == PM_LIGHT_AREA && l[3].shape == 0 && s.shapes[0].light == 3);
    check_spectrum(l[3].flux, 5.0 * PM_PI * PM_PI, 5.0 * PM_PI * PM_PI, 5.0 * PM_PI * PM_PI);
    CHECK(strcmp(l[3].id, "e") == 0);
    const double *below = s.shapes[1].area_below;
    CHECK(below != NULL);
    CHECK_NEAR(below[0], 2.0, 1e-14);
    CHECK_NEAR(below[11], 24.0, 1e-13);
    pm_scene_free(&s);
}

static void spots_and_skies(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s, "<emitter type='spot' id='s'><rgb name='intensity' value='1 2 3'/>"
            "<transform name='to_world'><scale value='3'/><lookat origin='1 2 3' target='1 2 1'"
            " up='0 1 0'/></transform></emitter>"
            "<emitter type='spot'><float name='cutoff_angle' value='30'/>"
            "<float name='beam_width' value='30'/></emitter>"
            "<emitter type='spot'><float name='cutoff_angle' value='120'/>"
            "<float name='beam_width' value='0'/></emitter>"
            "<emitter type='constant'><rgb name='radiance' value='1 0 2'/></emitter>"
            "<shape type='sphere'/>"));
    const pm_light *l = s.lights;
    CHECK(s.light_count == 5 && l[0].type == PM_LIGHT_SPOT && l[0].shape == PM_NONE);
    check_vector(pm_vec_add(l[0].position, s.center), 1.0, 2.0, 3.0);
    check_vector(l[0].direction, 0.0, 0.0, -1.0);
    CHECK_NEAR(l[0].cutoff, 20.0 * PM_PI / 180.0, 1e-15);
    CHECK_NEAR(l[0].beam, 15.0 * PM_PI / 180.0, 1e-15);
    check_spectrum(l[0].emitted, 1.0, 2.0, 3.0);
    double degree = PM_PI / 180.0;
    double sines = (sin(20.0 * degree) - sin(15.0 * degree)) / (5.0 * degree);
    CHECK_NEAR(l[0].flux.c[1], 4.0 * PM_PI * (1.0 - sines), 1e-13);
    // A beam as wide as the cone, and one of no width, whose cone is wider than a half space.
    CHECK_NEAR(l[1].flux.c[0], 2.0 * PM_PI * (1.0 - cos(30.0 * degree)), 1e-14);
    double wide = 1.0 - sin(120.0 * degree) / (120.0 * degree);
    CHECK_NEAR(l[2].flux.c[0], 2.0 * PM_PI * wide, 1e-14);
    CHECK(l[3].type == PM_LIGHT_CONSTANT && l[3].shape == PM_NONE);
    CHECK_NEAR(s.radius, pm_vec_length(pm_vec(1.0, 2.0, 3.0)), 1e-14); // spots count
    double sky = 4.0 * PM_PI * PM_PI * s.radius * s.radius;
    check_spectrum(l[3].flux, sky, 0.0, 2.0 * sky);
    pm_scene_free(&s);
}

static void equal_energy(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s,
                                "<emitter type='point'><spectrum name='intensity' value='4'/>"
                                "</emitter><bsdf type='diffuse'>"
                                "<spectrum name='reflectance' value='0.3'/></bsdf>"));
    // Mitsuba 3.9: [4.81918, 3.79316, 3.63566].
    CHECK_NEAR(s.lights[0].emitted.c[0], 4.81918, 1e-5);
    CHECK_NEAR(s.lights[0].emitted.c[1], 3.79316, 1e-5);
    CHECK_NEAR(s.lights[0].emitted.c[2], 3.63566, 1e-5);
    check_spectrum(s.materials[0].reflectance, 0.3, 0.3, 0.3);
    pm_scene_free(&s);
}

static void names(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s, "<shape type='sphere' id='ball'/>\n"
                                    "<shape type='sphere'/><shape type='sphere'/>\n"
                                    "<shape type='sphere'><emitter type='area'/></shape>"));
    CHECK_CONTAINS(s.shapes[0].id, "ball");
    CHECK(strcmp(s.shapes[1].id, "sphere@3") == 0);
    CHECK(strcmp(s.shapes[2].id, "sphere@3#2") == 0);
    CHECK(strcmp(s.shapes[3].id, "sphere@4") == 0);
    CHECK(strcmp(s.lights[0].id, "area@4") == 0);
    CHECK(s.note_count == 1);
    CHECK_CONTAINS(s.notes[0], "scene.xml:4: this light has no bsdf");
    pm_scene_free(&s);
}

static void own_scenes(void)
{
    static const char *const paths[6] = {
        "scenes/cornell-spheres.xml",   "scenes/cornell-diffuse.xml",
        "scenes/furnace.xml",           "scenes/integrating-sphere.xml",
        "scenes/square-over-floor.xml", "scenes/mesh-spheres.xml"};
    // Red channel of all lights together [W], as the scenes' head comments say.
    static const double flux[6] = {6.446548,  6.446548, 75.398224,
                                   12.566371, 3.141593, 810.5314};
    for (int i = 0; i < 6; i++) {
        pm_scene s = {0};
        CHECK_OK(pm_scene_read(paths[i], NULL, 0, true, &s));
        CHECK(s.light_count == 1);
        CHECK_NEAR(s.lights[0].flux.c[0], flux[i], 1e-6 * flux[i]);
        pm_scene_free(&s);
    }
}

PM_TESTS(
    {"scene_read.1", "shapes without parameters are Mitsuba's", plain_shapes},
    {"scene_read.2", "center, radius, p0 and p1 go through to_world", placed_shapes},
    {"scene_read.3", "mirrored and flipped shapes face where Mitsuba's face", mirrored_sides},
    {"scene_read.4", "mirrored and flipped meshes face where Mitsuba's face", mirrored_meshes},
    {"scene_read.5", "materials have their values and Mitsuba's defaults", materials},
    {"scene_read.6", "each bsdf covers the sides it should, also by reference ahead", sides},
    {"scene_read.7", "lights have their places, directions and powers", lights},
    {"scene_read.8", "a one-value spectrum is neutral for albedos, equal-energy for lights",
     equal_energy},
    {"scene_read.9", "what has no id is called TYPE@LINE", names},
    {"scene_read.10", "our own scenes are read and give the power they promise", own_scenes},
    {"scene_read.11", "spots and the constant light have Mitsuba's defaults and their powers",
     spots_and_skies},
    {"scene_read.12", "panes and plastics have their values and Mitsuba's defaults",
     coated_materials},
    {"scene_read.13", "rough metals have their values and Mitsuba's defaults", rough_metals},
    {"scene_read.14", "roughness and distribution belong to a scene's hash",
     roughness_is_hashed})
