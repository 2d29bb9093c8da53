// What the reader makes of media: their values, the sides of shapes, what it notes, and what
// depends on them.
#include "caps.h"
#include "scene_media_words.h"
#include "scene_text.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

static void check_medium(const pm_medium *medium, double sigma_t, pm_spectrum albedo, double g)
{
    CHECK_NEAR(medium->sigma_t, sigma_t, 0.0);
    CHECK_NEAR(medium->g, g, 0.0);
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(medium->albedo.c[i], albedo.c[i], 0.0);
    }
}

/// The only medium of a scene whose one shape holds it.
static void check_read(const char *inside, double sigma_t, pm_spectrum albedo, double g)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s,
                                "<phase type='hg' id='p'><float name='g' value='0.25'/></phase>"
                                "<shape type='sphere'><medium type='homogeneous' "
                                "name='interior'>%s</medium></shape>",
                                inside));
    CHECK(s.medium_count == 1 && s.shapes[0].boundary);
    CHECK(s.shapes[0].interior == 0 && s.shapes[0].exterior == PM_NONE);
    check_medium(&s.media[0], sigma_t, albedo, g);
    CHECK_CONTAINS(s.media[0].id, "homogeneous@");
    pm_scene_free(&s);
}

static void values(void)
{
    const pm_spectrum plain = pm_gray(0.75);
    check_read("", 1.0, plain, 0.0);
    check_read("<phase type='isotropic'/>", 1.0, plain, 0.0);
    check_read("<phase type='hg'/>", 1.0, plain, 0.8);
    check_read("<phase type='hg'><float name='g' value='-0.999'/></phase>", 1.0, plain, -0.999);
    check_read("<ref id='p'/>", 1.0, plain, 0.25);
    check_read("<float name='sigma_t' value='2.5'/><float name='scale' value='4'/>", 10.0,
               plain, 0.0);
    check_read("<rgb name='sigma_t' value='0.5 0.5 0.5'/>", 0.5, plain, 0.0);
    check_read("<spectrum name='sigma_t' value='7'/>", 7.0, plain, 0.0);
    check_read("<float name='sigma_t' value='0'/><rgb name='albedo' value='0 0.5 1'/>", 0.0,
               pm_rgb(0.0, 0.5, 1.0), 0.0);
}

static void sides(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s, FOG SMOKE BALL("0", "4", IN("fog"))
                                        BALL("0", "3", IN("smoke") OUT("fog"))
                                            BALL("0", "2", OUT("smoke")) BALL("0", "1", "")));
    static const struct {
        bool boundary;
        int interior, exterior;
    } want[4] = {{true, 0, PM_NONE}, {true, 1, 0}, {true, PM_NONE, 1}, {false, -1, -1}};
    CHECK(s.medium_count == 2 && strcmp(s.media[1].id, "smoke") == 0);
    for (int i = 0; i < 4; i++) {
        CHECK(s.shapes[i].boundary == want[i].boundary);
        CHECK(s.shapes[i].interior == want[i].interior);
        CHECK(s.shapes[i].exterior == want[i].exterior);
    }
    CHECK(s.lights[0].medium == PM_NONE); // in the middle of all of them
    pm_scene_free(&s);
}

static bool has_note(const pm_scene *scene, const char *part)
{
    for (int i = 0; i < scene->note_count; i++) {
        if (strstr(scene->notes[i], part) != NULL) {
            return true;
        }
    }
    return false;
}

static void noted(void)
{
    pm_scene s = {0};
    static const char *const mitsuba = "Mitsuba has it in none unless the sensor names";
    CHECK_OK(
        pm_scene_text_read(&s, FOG BALL("0", "3", IN("fog")) "<sensor type='perspective'/>"));
    CHECK(has_note(&s, mitsuba));
    pm_scene_free(&s);
    CHECK_OK(pm_scene_text_read(
        &s,
        FOG BALL("0", "3", IN("fog")) "<sensor type='perspective'><ref id='fog'/></sensor>"));
    CHECK(s.camera.medium == 0 && !has_note(&s, mitsuba));
    pm_scene_free(&s);
    CHECK_OK(pm_scene_text_read(&s, BALL("0", "3",
                                         "<medium type='homogeneous' name='interior'>"
                                         "<rgb name='sigma_t' value='2'/></medium>")));
    CHECK(has_note(&s, "Mitsuba takes an <rgb> sigma_t only up to 1"));
    pm_scene_free(&s);
}

static void unused(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s, SMOKE FOG BALL("0", "3", IN("fog"))));
    CHECK(s.medium_count == 1 && s.shapes[0].interior == 0 && s.lights[0].medium == 0);
    check_medium(&s.media[0], 0.5, pm_gray(0.75), 0.0);
    CHECK(has_note(&s, "nothing is in this medium: it is not used"));
    pm_scene_free(&s);
}

/// Of a ball with fog inside, in a scene with this printed before.
static uint64_t hash_of(const char *before, const char *sides)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s, "%s<shape type='sphere'><float name='radius' value='9'/>%s</shape>", before,
        sides));
    uint64_t hash = s.hash;
    pm_scene_free(&s);
    return hash;
}

static uint64_t hash_of_medium(const char *inside)
{
    char medium[300];
    snprintf(medium, sizeof medium, "<medium type='homogeneous' id='fog'>%s</medium>", inside);
    return hash_of(medium, IN("fog"));
}

static void hashed(void)
{
    uint64_t plain = hash_of_medium("");
    CHECK(hash_of_medium("<float name='scale' value='1'/>") == plain);
    CHECK(hash_of_medium("<float name='sigma_t' value='1.0000000000000002'/>") != plain);
    CHECK(hash_of_medium("<rgb name='albedo' value='0.75 0.75 0.76'/>") != plain);
    CHECK(hash_of_medium("<phase type='hg'/>") != plain);
    CHECK(hash_of(SMOKE FOG, IN("fog")) == hash_of(FOG SMOKE, IN("fog")));
    CHECK(hash_of(FOG, IN("fog")) != hash_of(FOG, OUT("fog")));
    CHECK(hash_of(FOG, IN("fog")) != hash_of(FOG, IN("fog") OUT("fog")));
    CHECK(hash_of(FOG SMOKE, "") == hash_of("", ""));
    CHECK(hash_of(FOG, IN("fog")) != hash_of("", ""));
}

static void hash_of_old(void)
{
    // As photon files of this scene had it before there were media.
    pm_scene s = {0};
    CHECK_OK(pm_scene_read("scenes/furnace.xml", NULL, 0, false, &s));
    CHECK_THAT(s.hash == 0xfc924de2b26431a8u, "%llx", (unsigned long long)s.hash);
    pm_scene_free(&s);
}

static uint32_t cap_of(double albedo)
{
    pm_medium medium = {.sigma_t = 1.0, .albedo = pm_rgb(0.5, albedo, 0.5)};
    pm_scene scene = {.media = &medium, .medium_count = 1};
    return pm_caps_of(&scene, 0).bounces;
}

static void capped(void)
{
    CHECK(cap_of(0.9999) == UINT32_MAX);
    CHECK(cap_of(0.99991) == 10000);
}

PM_TESTS({"scene_media.1", "media have the values of the file, and else Mitsuba's", values},
         {"scene_media.2", "a shape with a medium on either side parts media", sides},
         {"scene_media.3", "what Mitsuba would take otherwise is noted", noted},
         {"scene_media.4", "a medium that nothing is in is dropped, and noted", unused},
         {"scene_media.5", "the hash depends on media where something is in them", hashed},
         {"scene_media.6", "the hash of a scene without media is what it was", hash_of_old},
         {"scene_media.7", "a medium that keeps nearly all light has paths cut", capped})
