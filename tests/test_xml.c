// Files to trees: includes, defaults, substitution, limits.
#include "scene_text.h"
#include "test.h"
#include "xml.h"

#include <stdio.h>
#include <string.h>

static pm_xml *read(pm_arena *arena, pm_faults *faults, const char *path,
                    const pm_define *defines, int count)
{
    return pm_xml_read(path, defines, count, arena, faults);
}

static void tree(void)
{
    pm_arena arena = {0};
    pm_faults faults = {0};
    const char *path = pm_scene_text_write(
        "t.xml", "<?xml version='1.0'?>\n<scene version='3.0.0'>\n  <!-- a -->\n"
                 "  <a x='1' y='&lt;'>\n    <b/>\n    <c/>\n  </a>\n  <d/>\n</scene>");
    pm_xml *root = read(&arena, &faults, path, NULL, 0);
    CHECK(root != NULL && pm_faults_none(&faults));
    static const char *const tags[5] = {"scene", "a", "b", "c", "d"};
    static const int lines[5] = {2, 4, 5, 6, 8};
    pm_xml *e = root;
    for (int i = 0; i < 5; i++) {
        CHECK(e != NULL && strcmp(e->tag, tags[i]) == 0 && e->line == lines[i]);
        e = pm_xml_following(root, e);
    }
    CHECK(e == NULL);
    CHECK(strcmp(pm_xml_attribute(root->child, "y"), "<") == 0);
    CHECK(pm_xml_attribute(root->child, "z") == NULL);
    pm_arena_free(&arena);
}

/// The value of <a v='...'> behind two defaults, r = 7 and rr = 8.
static void check_replaced(const char *written, const char *want, const pm_define *defines,
                           int count)
{
    char text[400];
    snprintf(
        text, sizeof text,
        "<scene version='3.0.0'><default name='r' value='7'/><default name='rr' value='8'/>"
        "<default name='r' value='9'/><a v='%s'/></scene>",
        written);
    pm_arena arena = {0};
    pm_faults faults = {0};
    pm_xml *root = read(&arena, &faults, pm_scene_text_write("t.xml", text), defines, count);
    CHECK_OK(pm_faults_report(&faults));
    const char *got = pm_xml_attribute(root->child, "v");
    CHECK_THAT(strcmp(got, want) == 0, "%s became %s, not %s", written, got, want);
    pm_arena_free(&arena);
}

static void replaced(void)
{
    const pm_define define = {"r", "5"};
    check_replaced("plain", "plain", NULL, 0);
    check_replaced("$r", "7", NULL, 0);
    check_replaced("$r", "5", &define, 1);
    check_replaced("$rr", "8", &define, 1);
    check_replaced("a$r, $rrb$r", "a7, 8b7", NULL, 0);
    check_replaced("\\$r$r", "$r7", NULL, 0);
    const pm_define tricky = {"r", "$rr"};
    check_replaced("$r", "$rr", &tricky, 1);
}

static void wrong_define(void)
{
    pm_scene scene = {0};
    const pm_define define = {"widht", "5"};
    CHECK_FAILS(
        pm_scene_read("scenes/furnace.xml", &define, 1, false, &scene), PM_EINPUT,
        "scenes/furnace.xml: -D widht: the file has no <default> of this name; the nearest "
        "is width");
}

static void included(void)
{
    pm_scene_text_write("inner.xml", "<scene version='3.0.0'><default name='w' value='2'/>\n"
                                     "<b v='$u'/></scene>");
    const char *path = pm_scene_text_write(
        "outer.xml", "<scene version='3.0.0'><default name='u' value='1'/><a/>"
                     "<include filename='inner.xml'/><c v='$w'/></scene>");
    pm_arena arena = {0};
    pm_faults faults = {0};
    pm_xml *root = read(&arena, &faults, path, NULL, 0);
    CHECK_OK(pm_faults_report(&faults));
    const pm_xml *b = root->child->next;
    CHECK(strcmp(b->tag, "b") == 0 && b->parent == root && b->line == 2);
    CHECK_CONTAINS(b->file, "/inner.xml");
    CHECK(strcmp(pm_xml_attribute(b, "v"), "1") == 0);
    CHECK(strcmp(pm_xml_attribute(b->next, "v"), "2") == 0);
    pm_arena_free(&arena);
}

/// A chain of `files` files, each including the next.
static pm_status read_chain(int files)
{
    char name[40];
    char text[200];
    for (int i = 0; i < files; i++) {
        snprintf(name, sizeof name, "chain%d.xml", i);
        snprintf(text, sizeof text,
                 "<scene version='3.0.0'><include filename='chain%d.xml'/></scene>", i + 1);
        pm_scene_text_write(name, i + 1 < files ? text : "<scene version='3.0.0'/>");
    }
    pm_arena arena = {0};
    pm_faults faults = {0};
    read(&arena, &faults,
         pm_scene_text_write("chain.xml", "<scene version='3.0.0'>"
                                          "<include filename='chain0.xml'/></scene>"),
         NULL, 0);
    pm_arena_free(&arena);
    return pm_faults_report(&faults);
}

static void chains(void)
{
    CHECK_OK(read_chain(PM_XML_INCLUDE_MAX));
    CHECK_FAILS(read_chain(PM_XML_INCLUDE_MAX + 1), PM_EINPUT,
                "chain15.xml:1: too many includes");
}

static void bomb(void)
{
    // Eleven files that include the next one three times: 3^11 readings without a limit.
    char name[40];
    char text[400];
    for (int i = 0; i < 12; i++) {
        snprintf(name, sizeof name, "bomb%d.xml", i);
        snprintf(text, sizeof text,
                 "<scene version='3.0.0'><include filename='bomb%d.xml'/>"
                 "<include filename='bomb%d.xml'/><include filename='bomb%d.xml'/></scene>",
                 i + 1, i + 1, i + 1);
        pm_scene_text_write(name, i < 11 ? text : "<scene version='3.0.0'/>");
    }
    pm_scene scene = {0};
    char path[4096];
    snprintf(path, sizeof path, "%s/bomb0.xml", pm_test_folder());
    CHECK_FAILS(pm_scene_read(path, NULL, 0, false, &scene), PM_EINPUT, "1000 in all");
}

PM_TESTS({"xml.1", "elements keep their order, place and attributes", tree},
         {"xml.2", "$names are replaced, the longest first, once", replaced},
         {"xml.3", "a define without a default is refused with the nearest name", wrong_define},
         {"xml.4", "an included file sees and gives defaults, and keeps its own lines",
          included},
         {"xml.5", "files include each other sixteen deep and no deeper", chains},
         {"xml.6", "includes that multiply are stopped", bomb})
