// compare: how far picture A is from picture B, layer by layer, and whether that is a fault.
#include "compare.h"
#include "exr.h"
#include "program.h"
#include "report.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const pm_options_program program = {
    .name = "compare",
    .does = "Compares picture A with picture B, which is taken as right.",
    .positional = "A.exr B.exr",
    .positional_least = 2,
    .positional_most = 2,
    .options = "max-rel-mse same no-mask difference report",
    .notes =
        "rel_mse is mean((Y_A - Y_B)^2) / mean(Y_B)^2 of luminance Y, without emitters, their\n"
        "neighbours and a frame of 4 pixels; against a B with half1 and half2 it is\n"
        "mean((Y_A - Y_half1) (Y_A - Y_half2)) / mean(Y_B)^2, in which B's own noise drops "
        "out.\n"
        "--same averages the difference over tiles and asks, of the picture and of each "
        "layer,\n"
        "whether neighbouring tiles lean the same way: z is the sum of their products over "
        "its\n"
        "deviation, and chance stays below 5. Halves of a picture show how far its own noise\n"
        "leans, which is taken off. What lies within a few tiles is not told from noise.\n"
        "Exit code 1: rel_mse is above --max-rel-mse, or --same found a fault.",
};

/// What is measured, and what stays open while it is.
typedef struct {
    const pm_options *options;
    pm_image image[2];
    pm_compare_pair pair;
    pm_compare_part whole;
    pm_compare_part layers[PM_LAYER_COUNT];
    int layer_count;
    pm_compare_verdict verdict;
    char sentence[320];
    double full; // colour of --map
    bool failed;
} pm_job;

static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *part_to_json(const pm_compare_part *part)
{
    json_t *object = json_object();
    json_t *ratio = json_pack("[o,o,o]", number(part->mean_ratio[0]),
                              number(part->mean_ratio[1]), number(part->mean_ratio[2]));
    object = pm_report_add(object, "rel_mse", number(part->rel_mse));
    object = pm_report_add(object, "rel_rmse", number(part->rel_rmse));
    object = pm_report_add(object, "mean_ratio", ratio);
    object = pm_report_add(object, "max", number(part->max));
    return pm_report_add(object, "max_at", json_pack("[i,i]", part->max_x, part->max_y));
}

static json_t *same_to_json(const pm_job *job)
{
    static const char *const verdicts[] = {"equal", "noise", "uncertain", "fault"};
    json_t *object = json_object();
    object = pm_report_add(object, "verdict", json_string(verdicts[job->verdict]));
    object = pm_report_add(object, "z", number(job->whole.coherence.z));
    object = pm_report_add(object, "coherent", number(job->whole.coherence.coherent));
    return pm_report_add(object, "sentence", json_string(job->sentence));
}

static json_t *to_json(const pm_job *job)
{
    json_t *object = part_to_json(&job->whole);
    uint64_t all = (uint64_t)job->image[0].width * (uint64_t)job->image[0].height;
    object = pm_report_add(object, "halves", json_boolean(job->whole.halves));
    object = pm_report_add(object, "pixels", json_integer((json_int_t)job->pair.count));
    object = pm_report_add(object, "masked", json_integer((json_int_t)(all - job->pair.count)));
    json_t *layers = json_object();
    for (int i = 0; i < job->layer_count; i++) {
        layers = pm_report_add(layers, job->layers[i].name, part_to_json(&job->layers[i]));
    }
    object = pm_report_add(object, "layers", layers);
    return job->options->same ? pm_report_add(object, "same", same_to_json(job)) : object;
}

static void print_part(const pm_compare_part *part)
{
    printf("%-10s %12.5g %12.5g %9.4f %9.4f %9.4f %12.5g  %d,%d\n",
           part->name[0] != '\0' ? part->name : "picture", part->rel_mse, part->rel_rmse,
           part->mean_ratio[0], part->mean_ratio[1], part->mean_ratio[2], part->max,
           part->max_x, part->max_y);
}

// A layer that only one of the pictures has cannot be compared, and is named.
static void print_missing(const pm_job *job)
{
    for (int i = 0; i < PM_LAYER_COUNT; i++) {
        char channel[32];
        snprintf(channel, sizeof channel, "%s.R", pm_layer_name((pm_layer)i));
        bool a = pm_image_plane(&job->image[0], channel) != NULL;
        bool b = pm_image_plane(&job->image[1], channel) != NULL;
        if (a != b) {
            printf("the layer %s is in %s only\n", pm_layer_name((pm_layer)i), a ? "A" : "B");
        }
    }
}

static void print_table(const pm_job *job)
{
    printf("%-10s %12s %12s %29s %12s  at\n", "layer", "rel_mse", "rel_rmse",
           "mean ratio A/B: R, G, B", "max |A-B|");
    print_part(&job->whole);
    for (int i = 0; i < job->layer_count; i++) {
        print_part(&job->layers[i]);
    }
    print_missing(job);
    printf("%" PRIu64 " pixels compared%s\n", job->pair.count,
           job->whole.halves ? "; the noise of B is taken out by its halves" : "");
    if (job->whole.mean_b == 0.0 && job->whole.max > 0.0) {
        printf("B is black there: no relative error exists\n");
    }
    if (job->options->same) {
        printf("%s\n", job->sentence);
    }
    if (job->options->difference != NULL) {
        printf("%s: red where A is brighter, blue where darker; full colour at %.4g\n",
               job->options->difference, job->full);
    }
    if (job->options->has_max_rel_mse) {
        printf("rel_mse is %s %g\n",
               job->whole.rel_mse <= job->options->max_rel_mse ? "at most" : "NOT at most",
               job->options->max_rel_mse);
    }
}

static pm_status measure(pm_job *job)
{
    PM_TRY(pm_compare_measure(&job->pair, "", &job->whole));
    for (int i = 0; i < PM_LAYER_COUNT; i++) {
        const char *name = pm_layer_name((pm_layer)i);
        if (pm_compare_has(&job->pair, name)) {
            PM_TRY(pm_compare_measure(&job->pair, name, &job->layers[job->layer_count]));
            job->layer_count++;
        }
    }
    job->verdict = pm_compare_judge(&job->whole, job->layers, job->layer_count, job->sentence,
                                    sizeof job->sentence);
    // Written so that an undefined error (NaN) fails.
    bool within = job->whole.rel_mse <= job->options->max_rel_mse;
    job->failed = (job->options->has_max_rel_mse && !within) ||
                  (job->options->same && job->verdict == PM_COMPARE_FAULT);
    return PM_OK;
}

static pm_status run(pm_job *job)
{
    const pm_options *options = job->options;
    const char *const names[2] = {options->positional[0], options->positional[1]};
    for (int i = 0; i < 2; i++) {
        PM_TRY(pm_exr_read(names[i], &job->image[i]));
    }
    PM_TRY(pm_compare_pair_make(&job->image[0], &job->image[1], names, !options->no_mask,
                                &job->pair));
    PM_TRY(measure(job));
    if (options->difference != NULL) {
        PM_TRY(pm_compare_picture(&job->pair, options->difference, &job->full));
    }
    if (!options->json) {
        print_table(job);
    }
    return pm_report_end(options, to_json(job));
}

int main(int argc, char **argv)
{
    pm_options options;
    int code;
    if (!pm_program_start(argc, argv, &program, &options, &code)) {
        return code;
    }
    pm_job job = {.options = &options};
    pm_status status = run(&job);
    pm_compare_pair_free(&job.pair);
    pm_image_free(&job.image[0]);
    pm_image_free(&job.image[1]);
    code = pm_program_end(status);
    return code == 0 && job.failed ? 1 : code;
}
