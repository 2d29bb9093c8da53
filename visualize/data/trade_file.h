// What `tradeoff` measured: settings of a renderer, the time that each takes and the error that
// it leaves, as one JSON object
//
//     {"scene": "scenes/cornell-diffuse.xml",            optional
//      "points": [{"name": "lecture-10k",                 optional: a word for the point
//                  "settings": {"photons": 20000, "gather": 0, "filter": "cone"},
//                  "seconds": {"mean": 0.41, "sd": 0.02}, or a number: spread not known
//                  "rel_mse": {"mean": 0.013, "sd": 0.001},   alike
//                  "bias": 0.09, "variance": 0.005,       optional, both or none
//                  "peak_bytes": 31457280}],              optional
//      "pareto": [0],
//      "slope": -0.4}
//
// `seconds` are on the wall, `rel_mse` as compare reports it; `sd` is the standard deviation of
// one run, over runs with several seeds. `bias` is the root mean square over the pixels of what
// stays when runs without number are meant, `variance` the mean over the pixels of that of one
// run, both relative to the reference's mean: bias^2 + variance is rel_mse, and a bias too
// small to be told from noise is 0. rel_mse itself may be 0 or below against a reference with
// halves. `pareto` counts points from 0. `slope` is that of log rel_rmse over log seconds along
// the Pareto points, or null; or an object {NAME: slope, or {"measured": S, "predicted": S}}.
// What else an object holds is not looked at.
#ifndef PM_TRADE_FILE_H
#define PM_TRADE_FILE_H

#include "status.h"

#include <stdbool.h>

#define PM_TRADE_POINTS_MAX 4096
#define PM_TRADE_SETTINGS_MAX 32
#define PM_TRADE_SLOPES_MAX 8
#define PM_TRADE_WORD 40 // bytes, with the final zero

typedef struct {
    char option[PM_TRADE_WORD];
    char value[PM_TRADE_WORD]; // as it is written on a command line
} pm_trade_setting;

typedef struct {
    double mean, sd; // sd 0: not known
} pm_trade_value;

typedef struct {
    char name[PM_TRADE_WORD]; // "" without
    pm_trade_setting setting[PM_TRADE_SETTINGS_MAX];
    int setting_count;
    pm_trade_value seconds; // mean > 0
    pm_trade_value rel_mse;
    bool split; // bias and variance are known
    double bias, variance;
    double peak_bytes; // 0: not known
} pm_trade_point;

typedef struct {
    char name[PM_TRADE_WORD]; // "" for the Pareto points' own
    double measured, predicted;
    bool has_predicted;
} pm_trade_slope;

/// Free with pm_trade_file_free().
typedef struct {
    pm_trade_point *point;
    int point_count; // at least 1
    int *pareto;     // by seconds, the fastest first
    int pareto_count;
    pm_trade_slope slope[PM_TRADE_SLOPES_MAX];
    int slope_count;
} pm_trade;

/// Reads a file.
/// @param trade  [out] untouched unless PM_OK
/// @return PM_EIO; PM_EINPUT with file:line for what is no JSON (NaN is none), and with the
///         file and the place in it ("points[3].seconds") for what is missing, of the wrong
///         type or out of range
pm_status pm_trade_file_read(const char *path, pm_trade *trade);
void pm_trade_file_free(pm_trade *trade);

/// The value of an option at a point, or NULL where it has none.
const char *pm_trade_setting_of(const pm_trade_point *point, const char *option);

/// Whether a point without error, or with less than none, has no place on a logarithmic axis.
bool pm_trade_drawable(const pm_trade_point *point);

#endif
