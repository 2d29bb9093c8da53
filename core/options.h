// The one place that parses command lines, for every program. A program names the options it
// takes; everything else is refused with one line per fault that names the nearest option it
// does take. Nothing is clamped: a value is either in its stated range or an error.
#ifndef PM_OPTIONS_H
#define PM_OPTIONS_H

#include "estimate.h"
#include "layer.h"
#include "photon.h"
#include "scene_read.h"
#include "status.h"
#include "trace.h"

#include <stdbool.h>
#include <stdint.h>

#define PM_OPTIONS_REPEAT_MAX 64 // times that -D or --map may be given

/// What the colours of a picture stand for, in the order of the words of --by.
typedef enum {
    PM_BY_POWER,
    PM_BY_MAP,
    PM_BY_BOUNCE,
    PM_BY_LIGHT,
    PM_BY_EVENT,
} pm_by;

/// What a command line said, with the defaults where it said nothing. Texts point into argv.
typedef struct {
    const char *const *positional; // SCENE, or what the program's usage names
    int positional_count;

    // photons
    uint64_t photons[PM_MAP_COUNT]; // to emit for each map; 0: this map is off by choice
    uint64_t photons_total;         // --photons: to be split by the plan; 0: not given
    uint64_t stored; // from a preset: emit until each map holds so many; 0: emit `photons`
    pm_roulette_rule roulette;
    uint32_t max_bounces; // 0: the rule of the design
    bool unpacked;        // --packing off

    // estimate
    pm_estimate_settings estimate; // -k -r --shape --filter --kernel-constants --flatness
    bool k_given;                  // -k was on the command line or in a preset

    // picture
    uint32_t gather; // directions of a final gather; 0: global map seen directly
    uint32_t spp;
    bool view_photons;    // --view photons
    bool direct_photons;  // --direct photons
    bool caustics_global; // --caustics global
    bool precompute;      // --precompute on
    bool everywhere;      // --projection off
    uint64_t light_paths; // --light-paths, of the reference; 0: none
    bool media_march;     // --media march
    double march_step;    // --march-step [m]; 0: its own rule
    int width, height;    // --size; 0: the scene's
    int only;             // a pm_layer; -1: all
    const char *preset;   // NULL: none
    bool explain;         // say the plan and stop
    bool check_scene;     // render --check: validate the scene and stop
    double exposure;      // stops, of --png

    // progressive
    bool progressive;
    uint32_t passes;        // --passes
    bool gather_given;      // --gather was on the command line
    bool spp_given;         // --spp, likewise
    const char *checkpoint; // FILE, or NULL
    bool resume;

    // places
    bool has_at, has_normal;
    pm_vec3 at;         // the scene file's coordinates: subtract its centre
    pm_vec3 normal;     // unit
    const char *points; // file of points
    const char *on;     // id of a rectangle that is covered by a grid of points
    int grid_w, grid_h; // --grid; 0: not given
    bool has_part;      // --part was given
    double part[4];  // of the rectangle: u and v where the grid starts, u and v where it ends
    uint32_t runs;   // independent maps
    bool has_photon; // --photon was given
    uint64_t photon; // replay this one

    // files in and out
    const char *output; // -o
    const char *report;
    const char *png;
    const char *dump;
    const char *cells;      // emission --cells
    const char *visits;     // balancing --visits
    const char *gathered;   // radiance, filtering --gathered
    const char *curves;     // filtering --curves
    const char *check_file; // storage --check FILE
    const char *map[PM_OPTIONS_REPEAT_MAX];
    int map_count;
    const char *difference; // compare --map FILE.png
    const char *title;

    // view
    const char *scene; // that the data came from
    uint32_t depth;    // levels of a tree
    uint32_t paths;    // drawn at most
    int by;            // what colours stand for: a pm_by; -1: the kind's own
    const char *light; // id of the light that is looked at; NULL: all
    uint32_t frames;   // of a film
    double truth;      // --true: what an estimate should be; 0: not given
    bool display_x;    // --display x
    bool interactive;

    // compare
    bool no_mask, same;
    bool has_max_rel_mse;
    double max_rel_mse;

    // every program
    uint32_t seed;
    int threads; // 0: all
    bool json;
    bool help;
    pm_define define[PM_OPTIONS_REPEAT_MAX];
    int define_count;
} pm_options;

// Groups of keys that several programs take.
#define PM_OPTIONS_COMMON "seed threads json D help" // taken by all
#define PM_OPTIONS_ESTIMATE "k r shape filter kernel-constants flatness"

/// What a program takes. `options` and `needs` list keys separated by blanks: the option's name
/// without dashes ("n k r shape at"), except "check-file" for `--check FILE` and "difference"
/// for compare's `--map`. help, seed, threads, json and D are always taken.
typedef struct {
    const char *name;
    const char *does;       // one sentence for --help
    const char *positional; // as the usage line shows it: "SCENE", "A.exr B.exr"
    int positional_least;   // not asked for when --check FILE is given
    int positional_most;
    const char *options;
    const char *needs; // those of `options` that must be given; NULL: none
    const char *notes; // more lines for the end of --help; NULL: none
} pm_options_program;

/// The defaults of the design, before any command line.
pm_options pm_options_defaults(void);

/// Parses a command line; argv is reordered so that positionals come last, and the '=' of a
/// `-D name=value` becomes the end of its name.
///
/// With --help, whatever else is wrong, the answer is PM_OK with `help` set.
///
/// @param options  [out] untouched unless PM_OK; valid while argv is
/// @return PM_EINPUT with one line per fault: `render: --gather must be ..., got "x"`
pm_status pm_options_parse(int argc, char **argv, const pm_options_program *program,
                           pm_options *options);

#endif
