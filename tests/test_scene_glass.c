// Glasses that disperse, asked for by an instruction inside a dielectric.
#include "scene_text.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

/// The glass of a dielectric with this inside, or NULL for none.
static void check_glass(const char *inside, const char *want)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s, "<shape type='sphere'><bsdf type='dielectric'>%s</bsdf></shape>", inside));
    const pm_glass *glass = s.materials[s.shapes[0].material[0]].glass;
    if (want == NULL) {
        CHECK(glass == NULL);
    } else {
        CHECK_THAT(glass != NULL && strcmp(glass->name, want) == 0, "%s: not %s", inside, want);
        CHECK(glass == pm_glass_named(want));
    }
    pm_scene_free(&s);
}

static void named(void)
{
    static const char *const known[7] = {"bk7",          "sf10",    "sf11", "n-sf11",
                                         "fused-silica", "diamond", "water"};
    for (int i = 0; i < 7; i++) {
        char inside[60];
        snprintf(inside, sizeof inside, "<?photonlab glass %s?>", known[i]);
        check_glass(inside, known[i]);
    }
    check_glass("<?photonlab\n  glass   bk7 ?>", "bk7");
    check_glass("<float name='int_ior' value='1.7'/><?photonlab glass bk7?>", "bk7");
    check_glass("", NULL);
    check_glass("<?xml-stylesheet glass?><?mitsuba glass bk7?>", NULL);
}

static void by_define(void)
{
    const char *path = pm_scene_text_write(
        "glass.xml", "<scene version='3.0.0'><default name='kind' value='bk7'/>"
                     "<bsdf type='dielectric'><?photonlab glass $kind?></bsdf>"
                     "<emitter type='point'/></scene>");
    const pm_define define = {"kind", "water"};
    pm_scene s = {0};
    CHECK_OK(pm_scene_read(path, &define, 1, false, &s));
    CHECK(s.materials[0].glass == pm_glass_named("water"));
    pm_scene_free(&s);
}

static uint64_t hash_of(const char *inside)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(
        &s, "<shape type='sphere'><bsdf type='dielectric'>%s</bsdf></shape>", inside));
    uint64_t hash = s.hash;
    pm_scene_free(&s);
    return hash;
}

static void hashed(void)
{
    uint64_t plain = hash_of("");
    CHECK(hash_of("<?photonlab glass bk7?>") != plain);
    CHECK(hash_of("<?photonlab glass bk7?>") != hash_of("<?photonlab glass water?>"));
}

static void included(void)
{
    pm_scene_text_write("inner.xml",
                        "<scene version='3.0.0'>\n<?photonlab glass bk7?></scene>");
    const char *path = pm_scene_text_write(
        "outer.xml", "<scene version='3.0.0'><include filename='inner.xml'/></scene>");
    pm_scene s = {0};
    CHECK_FAILS(pm_scene_read(path, NULL, 0, false, &s), PM_EINPUT,
                "inner.xml:2: <?photonlab ...?> names the glass of a dielectric");
}

PM_TESTS({"scene_glass.1", "a dielectric learns its glass by name", named},
         {"scene_glass.2", "a glass may be a default of the file", by_define},
         {"scene_glass.3", "the hash depends on the glass", hashed},
         {"scene_glass.4", "an instruction of an included file is told with its own line",
          included})
