// Shadow photons: where they lie, which are light, and what is answered where.
#include "shadow.h"

#include "interrupt.h"
#include "photon_map.h"
#include "scenes.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

#include <omp.h>
#include <signal.h>
#include <string.h>

/// A floor of side 2 at z = 0 and, above its middle at height 1/2, a square of side `blocker`
/// that wears `material` (or nothing there).
static void begin_floor(pm_scenes *s, double blocker, int material)
{
    int gray = pm_scenes_diffuse(s, pm_gray(0.5));
    pm_scenes_wear(s, pm_scenes_square(2.0, 0.0, false), gray);
    if (blocker > 0.0) {
        pm_scenes_wear(s, pm_scenes_square(blocker, 0.5, false),
                       material == PM_NONE ? gray : material);
    }
}

static void add_lamp(pm_scenes *s)
{
    int lamp = pm_scenes_add(s, pm_scenes_square(0.3, 1.0, true), PM_NONE, PM_NONE);
    pm_scenes_lamp(s, lamp, pm_gray(1.0));
}

static const pm_photon_map *make(pm_scenes *s, uint64_t count, pm_shadow_maps *maps)
{
    pm_scenes_ready(s);
    CHECK_OK(pm_shadow_make(&s->world, &(pm_shadow_run){.seed = 1, .count = count}, maps));
    CHECK(maps->light_count == s->scene.light_count);
    return &maps->map[0];
}

static void done(pm_scenes *s, pm_shadow_maps *maps)
{
    pm_shadow_free(maps);
    CHECK(maps->map == NULL && maps->light_count == 0);
    pm_scenes_free(s);
}

static pm_shadow_answer ask_floor(const pm_shadow_maps *maps, int light, double x, double y)
{
    pm_neighbour scratch[PM_SHADOW_K];
    pm_estimate_point point = {pm_vec(x, y, 0.0), pm_vec(0.0, 0.0, 1.0)};
    return pm_shadow_ask(maps, light, &point, scratch);
}

// --- where they lie -------------------------------------------------------------------------

static void light_first_then_shadow(void)
{
    // From a point at height 1 the square of side 0.6 at 1/2 shades 1.2 x 1.2 of the floor.
    pm_scenes s;
    pm_scenes_begin(&s);
    begin_floor(&s, 0.6, PM_NONE);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
    pm_shadow_maps maps;
    const pm_photon_map *map = make(&s, 20000, &maps);
    int kinds[3] = {0, 0, 0}; // on the square, floor lit, floor in shadow
    for (uint32_t i = 0; i < map->count; i++) {
        pm_photon_view photon = pm_store_unpack(map, i);
        pm_vec3 at = photon.position;
        CHECK(photon.normal.z > 0.99); // the side that the light comes from
        double reach = pm_most(fabs(at.x), fabs(at.y));
        bool above = at.z > 0.25;
        bool shaded = !above && reach < 0.6;
        CHECK_THAT(photon.first != shaded || fabs(reach - 0.6) < 1e-4,
                   "a photon at %g %g %g says %d", at.x, at.y, at.z, photon.first);
        kinds[above ? 0 : 1 + shaded]++;
    }
    CHECK(kinds[0] == kinds[2] && kinds[0] > 1000 && kinds[1] > 1000);
    done(&s, &maps);
}

/// Photons of light and of shadow after 2000 from a point over blocker and floor.
static void count_behind(int (*wear)(pm_scenes *s), int *lit, int *dark)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    begin_floor(&s, 30.0, wear(&s));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
    pm_shadow_maps maps;
    const pm_photon_map *map = make(&s, 2000, &maps);
    *lit = *dark = 0;
    for (uint32_t i = 0; i < map->count; i++) {
        bool first = (map->photons[i].flags & PM_PHOTON_FIRST) != 0;
        *(first ? lit : dark) += 1;
    }
    done(&s, &maps);
}

static int wear_glass(pm_scenes *s)
{
    return pm_scenes_glass(s, 1.5);
}

static int wear_mirror(pm_scenes *s)
{
    return pm_scenes_mirror(s, pm_gray(1.0));
}

static int wear_gray(pm_scenes *s)
{
    return pm_scenes_diffuse(s, pm_gray(0.0)); // black, but D: it may be asked
}

static void what_throws_shadow(void)
{
    int lit, dark;
    count_behind(pm_scenes_null, &lit, &dark);
    CHECK(lit > 100 && dark == 0);
    int floor = lit;
    count_behind(wear_glass, &lit, &dark);
    CHECK(lit == 0 && dark == floor);
    count_behind(wear_mirror, &lit, &dark);
    CHECK(lit == 0 && dark == floor);
    count_behind(wear_gray, &lit, &dark);
    CHECK(lit > floor && dark == floor);
}

static void lights_share_alike(void)
{
    // In a closed room each photon marks one wall: unlike powers get the same number, lights
    // that are dark or everywhere none. What does not divide is shared out.
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 2.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.5, 0.0, 0.0), pm_gray(1e6));
    pm_scenes_point(&s, pm_vec(0.0, 0.5, 0.0), pm_gray(0.0));
    pm_scenes_point(&s, pm_vec(0.0, 0.5, 0.0), pm_gray(1e-6));
    pm_scenes_sky(&s, pm_gray(1.0));
    add_lamp(&s);
    pm_shadow_maps maps;
    make(&s, 10001, &maps);
    static const uint32_t want[5] = {3333, 0, 3334, 0, 3334};
    for (int i = 0; i < 5; i++) {
        CHECK_THAT(maps.map[i].count == want[i], "light %d has %u", i, maps.map[i].count);
        CHECK(want[i] == 0 || (maps.map[i].balanced && maps.map[i].kind == PM_MAP_GLOBAL));
    }
    CHECK(ask_floor(&maps, 1, 0.0, 0.0) == PM_SHADOW_UNSURE);
    CHECK(ask_floor(&maps, 3, 0.0, 0.0) == PM_SHADOW_UNSURE);
    done(&s, &maps);
}

static void lights_draw_for_themselves(void)
{
    // Two in the same place with as many photons: no photon of one is one of the other.
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(1.0));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(1.0));
    pm_shadow_maps maps;
    const pm_photon_map *one = make(&s, 200, &maps);
    const pm_photon_map *other = &maps.map[1];
    CHECK(one->count == 100 && other->count == 100);
    for (uint32_t i = 0; i < 100 * 100; i++) {
        const float *a = one->photons[i / 100].position;
        CHECK(memcmp(a, other->photons[i % 100].position, 3 * sizeof *a) != 0);
    }
    done(&s, &maps);
}

static void threads_change_no_byte(void)
{
    static const int threads[3] = {1, 2, 7};
    pm_scenes s;
    pm_scenes_balls(&s);
    pm_shadow_maps maps[3];
    for (int i = 0; i < 3; i++) {
        omp_set_num_threads(threads[i]);
        CHECK_OK(
            pm_shadow_make(&s.world, &(pm_shadow_run){.seed = 3, .count = 9000}, &maps[i]));
        for (int l = 0; l < maps[0].light_count; l++) {
            const pm_photon_map *a = &maps[0].map[l];
            const pm_photon_map *b = &maps[i].map[l];
            CHECK(a->count == b->count && a->count > 4400 &&
                  memcmp(a->photons, b->photons, a->count * sizeof *a->photons) == 0);
        }
    }
    pm_shadow_maps other;
    CHECK_OK(pm_shadow_make(&s.world, &(pm_shadow_run){.seed = 4, .count = 9000}, &other));
    CHECK(memcmp(other.map[0].photons, maps[0].map[0].photons, sizeof(pm_photon)) != 0);
    pm_shadow_free(&other);
    CHECK_OK(pm_shadow_make(&s.world, &(pm_shadow_run){3, 1, 9000}, &other));
    CHECK(memcmp(other.map[0].photons, maps[0].map[0].photons, sizeof(pm_photon)) != 0);
    CHECK(memcmp(other.map[0].photons, maps[0].map[1].photons, sizeof(pm_photon)) != 0);
    pm_shadow_free(&other);
    for (int i = 0; i < 3; i++) {
        pm_shadow_free(&maps[i]);
    }
    pm_scenes_free(&s);
}

static void an_interrupt_stops_it(void)
{
    pm_scenes s;
    pm_scenes_balls(&s);
    pm_interrupt_catch();
    raise(SIGINT);
    pm_shadow_maps maps = {0};
    CHECK_FAILS(pm_shadow_make(&s.world, &(pm_shadow_run){.seed = 1, .count = 100000}, &maps),
                PM_ESTOPPED, "");
    CHECK(maps.map == NULL && maps.light_count == 0);
    pm_scenes_free(&s);
}

// --- what is answered -----------------------------------------------------------------------

static void answers(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    begin_floor(&s, 0.6, PM_NONE);
    add_lamp(&s);
    pm_shadow_maps maps;
    make(&s, 50000, &maps);
    CHECK(ask_floor(&maps, 0, 0.0, 0.0) == PM_SHADOW_DARK); // umbra: 0.45 about the middle
    CHECK(ask_floor(&maps, 0, 0.6, 0.0) == PM_SHADOW_UNSURE);
    CHECK(ask_floor(&maps, 0, 0.9, 0.9) == PM_SHADOW_LIT);
    done(&s, &maps);
}

static void too_few_photons_say_nothing(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    begin_floor(&s, 0.0, PM_NONE);
    pm_scenes_sun(&s, pm_vec(0.0, 0.0, -1.0), pm_gray(1.0));
    pm_shadow_maps maps;
    const pm_photon_map *map = make(&s, 64, &maps);
    CHECK(map->count > 0 && map->count < PM_SHADOW_K);
    CHECK(ask_floor(&maps, 0, 0.0, 0.0) == PM_SHADOW_UNSURE);
    done(&s, &maps);
    // Enough of them, but all on the other side of the sheet.
    pm_scenes_begin(&s);
    begin_floor(&s, 0.0, PM_NONE);
    pm_scenes_sun(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
    map = make(&s, 6400, &maps);
    CHECK(map->count > PM_SHADOW_K);
    CHECK(ask_floor(&maps, 0, 0.0, 0.0) == PM_SHADOW_UNSURE);
    done(&s, &maps);
}

static void thin_shadows_are_rarely_missed(void)
{
    // A strip that shades the share q of the disc of K photons is missed with probability
    // (1 - q)^K: what is missed by less than 1 in 100 begins at a tenth of the disc.
    int missed = 0;
    int asked = 0;
    for (double width = 0.05; width < 0.2; width += 0.05) {
        pm_scenes s;
        pm_scenes_begin(&s);
        begin_floor(&s, 0.0, PM_NONE);
        pm_shape strip = pm_shapes_rectangle(pm_vec(-1.0, -0.5 * width, 0.5),
                                             pm_vec(2.0, 0.0, 0.0), pm_vec(0.0, width, 0.0));
        pm_scenes_wear(&s, strip, 0);
        pm_scenes_sun(&s, pm_vec(0.0, 0.0, -1.0), pm_gray(1.0));
        pm_shadow_maps maps;
        make(&s, 20000, &maps); // about 2100 a unit of area: 48 in a disc of radius 0.085
        for (double x = -0.9; x < 0.9; x += 0.02) {
            missed += ask_floor(&maps, 0, x, 0.4 * width) == PM_SHADOW_LIT;
            asked++;
        }
        done(&s, &maps);
    }
    CHECK(asked > 250);
    CHECK_THAT(missed <= asked / 100, "%d of %d points in thin shadows called lit", missed,
               asked);
}

PM_TESTS(
    {"shadow.1", "light marks the first surface, shadow those behind it",
     light_first_then_shadow},
    {"shadow.2", "glass and mirrors throw shadow, null surfaces do not", what_throws_shadow},
    {"shadow.3", "each light with power has as many photons, however weak", lights_share_alike},
    {"shadow.4", "lights in one place do not repeat each other's photons",
     lights_draw_for_themselves},
    {"shadow.5", "the maps are the same for any number of threads", threads_change_no_byte},
    {"shadow.6", "an interrupt stops it and leaves nothing behind", an_interrupt_stops_it},
    {"shadow.7", "umbra, penumbra and open floor are told apart", answers},
    {"shadow.8", "too few photons, or those of another side, say nothing",
     too_few_photons_say_nothing},
    {"shadow.9", "shadows as thin as a tenth of the photons' disc are seen",
     thin_shadows_are_rarely_missed})
