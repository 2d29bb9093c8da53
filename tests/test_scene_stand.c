// In which medium the camera and each light stand: found from the shapes that part media, held
// against distances to their centres.
#include "scene_media_words.h"
#include "scene_text.h"
#include "test.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/// The medium of a camera at x, 0, 0 among these shapes.
static int camera_at(double x, const char *shapes)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s,
                                FOG SMOKE
                                "%s<sensor type='perspective'><transform name='to_world'>"
                                "<translate x='%.17g'/></transform></sensor>",
                                shapes, x));
    int medium = s.camera.medium;
    pm_scene_free(&s);
    return medium;
}

static void nested(void)
{
    static const char *const shells = BALL("0", "3", IN("fog"))
        BALL("0", "2", IN("smoke") OUT("fog")) BALL("0", "1", OUT("smoke"));
    CHECK(camera_at(3.5, shells) == PM_NONE);
    CHECK(camera_at(2.5, shells) == 0);
    CHECK(camera_at(-2.001, shells) == 0);
    CHECK(camera_at(1.999, shells) == 1);
    CHECK(camera_at(0.999, shells) == PM_NONE);
    CHECK(camera_at(1e9, shells) == PM_NONE);
}

static void flipped(void)
{
    // Mitsuba 3.9.1 has the interior on the side that the final normal points away from,
    // flipped or not.
    static const char *const cube = "<shape type='cube'>" IN("fog") OUT("smoke") "</shape>";
    CHECK(camera_at(0.5, cube) == 0);
    CHECK(camera_at(1.5, cube) == 1);
    static const char *const turned =
        "<shape type='cube'>" FLIP IN("fog") OUT("smoke") "</shape>";
    CHECK(camera_at(0.5, turned) == 1);
    CHECK(camera_at(1.5, turned) == 0);
    static const char *const mirrored = "<shape type='sphere'>" IN("fog")
        OUT("smoke") "<transform name='to_world'><scale x='-1'/></transform></shape>";
    CHECK(camera_at(0.5, mirrored) == 1);
    CHECK(camera_at(1.5, mirrored) == 0);
}

static void other_shapes(void)
{
    // A wall and a ball of glass stand in the fog; the ball has fog inside.
    static const char *const things = "<shape type='cube'>" IN(
        "fog") "<bsdf type='null'/>"
               "<transform name='to_world'><scale value='9'/></transform></shape>"
               "<shape type='rectangle'/>"
               "<shape type='sphere'><point name='center' value='3 0 0'/>"
               "<bsdf type='dielectric'/></shape>";
    CHECK(camera_at(1.5, things) == 0);
    CHECK(camera_at(3.0, things) == 0);
    CHECK(camera_at(9.5, things) == PM_NONE);
}

/// One of many balls, each of its own kind, in a box of fog.
typedef struct {
    pm_vec3 center;
    int medium;
} bubble;

/// Balls of radius 0.4 on a grid of 3 x 3 x 3 in a cube of half width 2; every third is empty,
/// every third full of smoke, every third of fog.
static bubble bubble_at(int i)
{
    return (bubble){pm_vec(i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0),
                    i % 3 == 0 ? PM_NONE : i % 3 - 1};
}

/// Appends to the text of `room` bytes.
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static void
append(char *text, size_t room, const char *format, ...)
{
    size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text + used, room - used, format, arguments);
    va_end(arguments);
    CHECK(length > 0 && (size_t)length < room - used);
}

static void append_bubbles(char *text, size_t room)
{
    static const char *const sides[3] = {OUT("fog"), IN("fog") OUT("fog"),
                                         IN("smoke") OUT("fog")};
    append(text, room,
           "<shape type='cube'>" IN("fog") "<transform name='to_world'>"
                                           "<scale value='2'/></transform></shape>");
    for (int i = 0; i < 27; i++) {
        pm_vec3 c = bubble_at(i).center;
        append(text, room,
               "<shape type='sphere'><point name='center' value='%g %g %g'/>"
               "<float name='radius' value='0.4'/>%s</shape>",
               c.x, c.y, c.z, sides[i % 3]);
    }
}

/// Which medium is at a point of the room of bubbles, by the distances alone.
static int contained(pm_vec3 at)
{
    for (int i = 0; i < 27; i++) {
        bubble b = bubble_at(i);
        if (pm_vec_length(pm_vec_sub(at, b.center)) < 0.4) {
            return b.medium;
        }
    }
    return pm_vec_reach(at) < 2.0 ? 0 : PM_NONE;
}

static void brute_force(void)
{
    enum { POINTS = 60 };
    char text[12000] = "<scene version='3.0.0'>" FOG SMOKE;
    append_bubbles(text, sizeof text);
    uint32_t state = 12345; // an even spread is enough here
    pm_vec3 at[POINTS];
    for (int i = 0; i < POINTS; i++) {
        double x[3];
        for (int k = 0; k < 3; k++) {
            state = 1664525u * state + 1013904223u;
            x[k] = 4.6 * (state * 0x1p-32 - 0.5);
        }
        at[i] = i < 27 ? pm_vec_along(bubble_at(i).center, pm_vec(x[0], x[1], x[2]), 0.05)
                       : pm_vec(x[0], x[1], x[2]);
        append(text, sizeof text,
               "<emitter type='point'><point name='position' value='%.17g %.17g %.17g'/>"
               "</emitter>",
               at[i].x, at[i].y, at[i].z);
    }
    append(text, sizeof text, "</scene>");
    pm_scene s = {0};
    CHECK_OK(pm_scene_read(pm_scene_text_write("bubbles.xml", text), NULL, 0, false, &s));
    int seen[3] = {0, 0, 0};
    for (int i = 0; i < POINTS; i++) {
        CHECK_THAT(s.lights[i].medium == contained(at[i]), "%g %g %g: %d, not %d", at[i].x,
                   at[i].y, at[i].z, s.lights[i].medium, contained(at[i]));
        seen[s.lights[i].medium + 1]++;
    }
    CHECK(seen[0] > 5 && seen[1] > 5 && seen[2] > 5);
    pm_scene_free(&s);
}

/// The media of all lights of a scene with FOG and SMOKE but the helper's own.
static void check_lights(const char *body, const int *want, int count)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s, FOG SMOKE "%s", body));
    CHECK(s.light_count == count + 1);
    for (int i = 0; i < count; i++) {
        CHECK_THAT(s.lights[i].medium == want[i], "light %s: %d, not %d", s.lights[i].id,
                   s.lights[i].medium, want[i]);
    }
    pm_scene_free(&s);
}

#define ROOM                                                                                   \
    "<shape type='cube'>" IN("fog") "<transform name='to_world'><scale value='9'/>"            \
                                    "</transform></shape>"
#define LAMP(x, sides) BALL(x, "0.5", sides "<emitter type='area'/>")
#define BULB(x) "<emitter type='point'><point name='position' value='" x " 0 0'/></emitter>"

static void lights(void)
{
    // In clear air inside of a glass ball, in the fog inside of another, in the fog itself.
    static const int balls[3] = {PM_NONE, 0, 0};
    check_lights(ROOM BALL("2", "1", OUT("fog") "<bsdf type='dielectric'/>")
                     BALL("-2", "1", "<bsdf type='dielectric'/>") BULB("2") BULB("-2.5")
                         BULB("5"),
                 balls, 3);
    // Area lights shine from their normal's side, whatever is behind it.
    static const int lamps[5] = {0, 0, 1, PM_NONE, PM_NONE};
    check_lights(ROOM LAMP("2", "") LAMP("4", IN("smoke") OUT("fog"))
                     BALL("-4", "2", IN("smoke") OUT("fog")) LAMP("-4", "") LAMP("20", "")
                         BULB("-20"),
                 lamps, 5);
    // On the wall, facing in and facing out.
    static const int walls[2] = {0, PM_NONE};
    check_lights(ROOM
                 "<shape type='rectangle'><transform name='to_world'><translate z='-8.99'/>"
                 "</transform><emitter type='area'/></shape>"
                 "<shape type='rectangle'><transform name='to_world'><translate z='9.01'/>"
                 "</transform><emitter type='area'/></shape>",
                 walls, 2);
    static const int sun[2] = {PM_NONE, PM_NONE};
    check_lights(ROOM "<emitter type='directional'/><emitter type='constant'/>", sun, 2);
}

static void everywhere(void)
{
    pm_scene s = {0};
    CHECK_OK(pm_scene_text_read(&s,
                                FOG SMOKE "<shape type='sphere'/><sensor type='perspective'>"
                                          "<ref id='smoke'/></sensor>"
                                          "<emitter type='spot'><ref id='smoke'/></emitter>"));
    CHECK(s.medium_count == 1 && s.camera.medium == 0 && !s.shapes[0].boundary);
    CHECK(strcmp(s.media[0].id, "smoke") == 0);
    CHECK(s.lights[0].medium == 0 && s.lights[1].medium == 0);
    pm_scene_free(&s);
    // What takes nothing lets a sun through.
    CHECK_OK(pm_scene_text_read(&s, "<shape type='sphere'/><medium type='homogeneous' id='air'>"
                                    "<float name='sigma_t' value='0'/></medium>"
                                    "<emitter type='directional'><ref id='air'/></emitter>"));
    CHECK(s.medium_count == 1 && s.lights[0].medium == 0 && s.lights[1].medium == 0);
    pm_scene_free(&s);
}

PM_TESTS({"scene_stand.1", "a camera between nested media stands in the one around it", nested},
         {"scene_stand.2", "the interior is behind the normal, flipped and mirrored too",
          flipped},
         {"scene_stand.3", "shapes that part no media leave everything in the one it is in",
          other_shapes},
         {"scene_stand.4", "lights among 27 balls stand in what their distances say",
          brute_force},
         {"scene_stand.5", "lights stand on the side that they shine to", lights},
         {"scene_stand.6", "without boundaries all stand in the medium that one of them names",
          everywhere})
