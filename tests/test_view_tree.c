// Which split came first must be seen: the root's plane has the boldest outline.
#include "room.h"
#include "seen.h"

static const uint8_t vermillion[3] = {213, 94, 0};

/// Longest in x, so the root is across x; then y, then x again among the leaves. A
/// left-balanced tree of seven has three photons on each side of its root: it goes through x
/// = 5.
static const pm_vec3 wide[] = {{4.5, 4.9, 5.0}, {4.6, 5.1, 5.0}, {4.8, 5.3, 5.0},
                               {5.0, 4.8, 5.0}, {5.1, 5.2, 4.9}, {5.3, 5.0, 5.1},
                               {5.5, 4.9, 5.0}};

/// Pixels in a row around where x is seen, at the height y, that have about this colour.
static int count_across(const pm_seen *s, double x, double y, double z)
{
    int column = 0;
    int row = 0;
    int count = 0;
    pm_seen_place(s, 0, pm_vec(x, y, z), &column, &row);
    for (int i = -8; i <= 8; i++) {
        count += pm_seen_near(s, column + i, row, 0, vermillion, 30) ? 1 : 0;
    }
    return count;
}

static void first_split_is_boldest(void)
{
    const char *map = pm_room_map("tree.ply", wide, 7, pm_gray(1.0), true);
    pm_seen s = pm_seen_look("view tree {S} --scene {O} --size 640x480", map, pm_room_scene());
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "7 photons, tree of height 2; planes down to "
                                             "depth 2: 7; dots: 7 photons");
    CHECK(pm_seen_number(&s, "drawn") == 7.0);
    int bold = count_across(&s, 5.0, 5.15, 5.1);
    int deep = count_across(&s, 4.8, 5.25, 5.1);
    CHECK_THAT(bold >= 3, "the root's outline is %d pixels wide", bold);
    CHECK_THAT(deep < bold, "an outline of depth 2 is %d pixels wide, the root's %d", deep,
               bold);
    pm_seen_free(&s);
}

PM_TESTS({"view_tree.1", "the first split has the boldest outline", first_split_is_boldest})
