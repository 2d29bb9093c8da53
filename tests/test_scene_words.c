// The small parts of the reader: numbers, nearest words, refractive indices, faults, memory.
#include "arena.h"
#include "faults.h"
#include "ior.h"
#include "nearest.h"
#include "number.h"
#include "scene_words.h"
#include "test.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static void numbers(void)
{
    static const struct {
        const char *text;
        double value;
    } good[7] = {{"1", 1.0},         {" -2.5 ", -2.5},     {"+3e2", 300.0}, {".5", 0.5},
                 {"1e-320", 1e-320}, {"1.7e308", 1.7e308}, {"-0", 0.0}};
    for (int i = 0; i < 7; i++) {
        double value = 77.0;
        const char *wrong = pm_number_read(good[i].text, &value);
        CHECK_THAT(wrong == NULL, "%s %s", good[i].text, wrong);
        CHECK_NEAR(value, good[i].value, 0.0);
    }
    static const char *const bad[10] = {"",    " ",    "x",   "1 2",    "1m",
                                        "nan", "-inf", "0x1", "1e5000", "1e-5000"};
    for (int i = 0; i < 10; i++) {
        double value = 77.0;
        CHECK_THAT(pm_number_read(bad[i], &value) != NULL, "\"%s\" is read as %g", bad[i],
                   value);
        CHECK(value == 77.0);
    }
}

static void check_list(const char *text, int want)
{
    double values[3];
    int count = -1;
    const char *wrong = pm_number_list(text, values, 3, &count);
    CHECK_THAT((wrong == NULL ? count : -1) == want, "\"%s\" has %d numbers, not %d", text,
               wrong == NULL ? count : -1, want);
    for (int i = 0; i < want && i < 3; i++) {
        CHECK_NEAR(values[i], i + 1.0, 0.0);
    }
}

static void lists(void)
{
    check_list("", 0);
    check_list("1 2 3", 3);
    check_list(" 1,2 ,\n3 ", 3);
    check_list("1,2,3,4", 4);
    check_list("1,,2", -1);
    check_list("1;2", -1);
    check_list("1 nan", -1);
}

static void nearest(void)
{
    static const char *const words[3] = {"sphere", "disk", "cylinder"};
    CHECK_CONTAINS(pm_nearest_word("spehre", words, 3), "sphere");
    CHECK_CONTAINS(pm_nearest_word("risk", words, 3), "disk");
    CHECK_CONTAINS(pm_nearest_word("cylynder", words, 3), "cylinder");
    CHECK(pm_nearest_word("sphere", words, 0) == NULL);
}

static void indices(void)
{
    double index = 0.0;
    const char *name = "";
    CHECK(pm_ior_find("diamond", &index, &name));
    CHECK_NEAR(index, 2.419, 0.0);
    CHECK(pm_ior_find("Carbon Dioxide", &index, &name));
    CHECK_NEAR(index, 1.00045, 0.0);
    CHECK(!pm_ior_find("diamant", &index, &name));
    CHECK_NEAR(index, 1.00045, 0.0);
    CHECK_CONTAINS(name, "diamond");
}

static void proposed(void)
{
    CHECK(pm_scene_words_plugin("shape", "diffuse") == NULL);
    CHECK_CONTAINS(pm_scene_words_nearest_plugin("emitter", "sport"), "spot");
    CHECK_CONTAINS(pm_scene_words_nearest_plugin("phase", "isotrop"), "isotropic");
    CHECK_CONTAINS(pm_scene_words_nearest_element("mediun"), "medium");
    CHECK(pm_scene_words_nearest_plugin("integrator", "path") == NULL);
}

static void faults_line_up(void)
{
    pm_faults faults = {0};
    CHECK(pm_faults_none(&faults));
    CHECK_OK(pm_faults_report(&faults));
    pm_faults_add(&faults, "a.xml", 3, "one\ntwo");
    pm_faults_add(&faults, "a.xml", 0, "%0500d", 7);
    CHECK_FAILS(pm_faults_report(&faults), PM_EINPUT, "a.xml:3: one?two\na.xml: 000");
    CHECK(strlen(faults.lines[1]) == PM_FAULTS_LINE - 1);
    CHECK_CONTAINS(faults.lines[1] + PM_FAULTS_LINE - 4, "...");
    for (int i = 0; i < 30; i++) {
        pm_faults_add(&faults, "a.xml", i, "more");
    }
    CHECK(faults.count == PM_FAULTS_MAX);
    pm_faults_fail(&faults, PM_ENOMEM);
    CHECK_FAILS(pm_faults_report(&faults), PM_ENOMEM, "no memory");
}

static void memory(void)
{
    pm_arena arena = {0};
    CHECK(pm_arena_take(&arena, SIZE_MAX / 4, 8) == NULL);
    unsigned char *pieces[200];
    for (size_t i = 0; i < 200; i++) {
        size_t bytes = 1 + i * i * 10;
        pieces[i] = pm_arena_take(&arena, 1, bytes);
        CHECK(pieces[i] != NULL && (uintptr_t)pieces[i] % _Alignof(max_align_t) == 0);
        for (size_t b = 0; b < bytes; b++) {
            CHECK(pieces[i][b] == 0);
        }
        memset(pieces[i], (int)i, bytes);
    }
    for (size_t i = 0; i < 200; i++) {
        CHECK(pieces[i][0] == i && pieces[i][i * i * 10] == i);
    }
    CHECK_CONTAINS(pm_arena_print(&arena, "%s-%d", "a", 7), "a-7");
    pm_arena_free(&arena);
    CHECK(arena.blocks == NULL);
}

PM_TESTS({"number.1", "numbers are finite, decimal, and alone", numbers},
         {"number.2", "lists are separated by blanks or single commas", lists},
         {"nearest.1", "the nearest word is found", nearest},
         {"ior.1", "refractive indices are found by name", indices},
         {"scene_words.1", "the nearest word is one of the same kind", proposed},
         {"faults.1", "faults are one line each, twenty at most", faults_line_up},
         {"arena.1", "pieces are aligned, zeroed and do not overlap", memory})
