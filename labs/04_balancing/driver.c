// balancing: the photons of a scene become a kd-tree, and the k nearest are looked up in it.
//
// For comparison the same photons also go into a tree that grows by itself. What is done with
// one is done with the other, so that the numbers can stand side by side.
#include "balance.h"
#include "clock.h"
#include "file.h"
#include "grown_tree.h"
#include "map_make.h"
#include "photon_file.h"
#include "photon_map.h"
#include "program.h"
#include "report.h"
#include "tree_dump.h"
#include "visit_dump.h"
#include "world.h"

#include <stdio.h>
#include <stdlib.h>

#define QUERIES 2000u // photons around which is searched, spread evenly over the map

static const pm_options_program program = {
    .name = "balancing",
    .does = "Builds the kd-tree of a scene's global photon map and measures searches in it.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n projection k r roulette max-bounces packing o dump at "
               "visits report",
    .notes =
        "-o writes the balanced map. Searches are around photons of the map, without side\n"
        "test. height counts the links from the root to the deepest photon; unbalanced is\n"
        "a tree that photons are inserted into as they come. Of a scene with media the global\n"
        "map is taken, too: trees of volume maps are made the same way.\n"
        "--dump writes both trees: their levels, and the planes of the first ones.\n"
        "--visits writes what a search for the k nearest of --at looks at, in both trees, a\n"
        "photon a line, in the search's own order; a small -k and -n make it readable.",
};

typedef struct {
    const pm_options *options;
    pm_world world;
    pm_photon_map map;
    pm_vec3 *queries;
    uint32_t query_count;
    double visited, visited_unbalanced; // means
    double build_s, query_s;            // CPU
    pm_file dump, visits;
} pm_job;

/// What searches came to.
typedef struct {
    pm_neighbour *nearest; // room for k
    uint32_t found;        // by the last one
    uint64_t visited;      // by all
} answer;

// --- one tree or the other ------------------------------------------------------------------

/// The tree of a job: the grown one, or with NULL the balanced map.
static pm_status look_up(const pm_job *job, pm_grown_tree *grown, const pm_search *search,
                         answer *got)
{
    if (grown != NULL) {
        pm_grown_tree_nearest(grown, search, got->nearest, &got->found, &got->visited);
        return PM_OK;
    }
    return pm_balance_nearest(&job->map, search, got->nearest, &got->found, &got->visited);
}

static pm_status make_room(const pm_job *job, answer *got)
{
    uint32_t k = job->options->estimate.k;
    *got = (answer){.nearest = malloc((size_t)k * sizeof *got->nearest)};
    return got->nearest != NULL ? PM_OK
                                : PM_FAIL(PM_ENOMEM, "no memory to search for %u photons", k);
}

static pm_search search_around(const pm_job *job, pm_vec3 at)
{
    const pm_estimate_settings *settings = &job->options->estimate;
    return (pm_search){
        .at = at, .k = settings->k, .radius2 = settings->radius * settings->radius};
}

/// @param visited_mean  [out] photons looked at in a search
static pm_status measure(const pm_job *job, pm_grown_tree *grown, double *visited_mean)
{
    answer got;
    PM_TRY(make_room(job, &got));
    pm_status status = PM_OK;
    for (uint32_t i = 0; i < job->query_count && status == PM_OK; i++) {
        pm_search search = search_around(job, job->queries[i]);
        status = look_up(job, grown, &search, &got);
    }
    free(got.nearest);
    *visited_mean = (double)got.visited / job->query_count;
    return status;
}

/// Writes the visits of the one search around --at.
static pm_status watch(pm_job *job, pm_grown_tree *grown, const pm_tree *tree)
{
    pm_vec3 center = job->world.scene.center;
    pm_search search = search_around(job, pm_vec_sub(job->options->at, center));
    pm_visit_list seen = {0};
    search.visit = pm_visit_list_add;
    search.witness = &seen;
    answer got;
    PM_TRY(make_room(job, &got));
    pm_status status = look_up(job, grown, &search, &got);
    if (status == PM_OK) {
        pm_watched watched = {tree, &search, &seen, got.nearest, got.found, got.visited};
        status = pm_visit_dump(job->visits.stream, &watched, center);
    }
    free(got.nearest);
    pm_visit_list_free(&seen);
    return status;
}

static pm_status write_tables(pm_job *job, pm_grown_tree *grown, const pm_tree *tree,
                              double visited_mean)
{
    if (job->dump.stream != NULL) {
        PM_TRY(pm_tree_dump(job->dump.stream, tree, visited_mean, job->world.scene.center));
    }
    return job->visits.stream != NULL ? watch(job, grown, tree) : PM_OK;
}

static pm_status use_grown(pm_job *job)
{
    pm_grown_tree *grown = NULL;
    PM_TRY(pm_grown_tree_make(&job->map, &grown));
    pm_status status = measure(job, grown, &job->visited_unbalanced);
    if (status == PM_OK) {
        status = write_tables(job, grown, pm_grown_tree_links(grown), job->visited_unbalanced);
    }
    pm_grown_tree_free(grown);
    return status;
}

static pm_status use_balanced(pm_job *job)
{
    double start = pm_cpu_seconds_now();
    PM_TRY(measure(job, NULL, &job->visited));
    job->query_s = pm_cpu_seconds_now() - start;
    pm_tree tree = pm_tree_of_map(&job->map);
    return write_tables(job, NULL, &tree, job->visited);
}

// --- the job --------------------------------------------------------------------------------

static pm_status choose_queries(pm_job *job)
{
    uint32_t count = job->map.count < QUERIES ? job->map.count : QUERIES;
    job->queries = malloc((size_t)count * sizeof *job->queries + 1);
    if (job->queries == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %u searches", count);
    }
    for (uint32_t i = 0; i < count; i++) {
        uint64_t photon = (uint64_t)i * job->map.count / count;
        const float *at = job->map.photons[photon].position;
        job->queries[i] = pm_vec((double)at[0], (double)at[1], (double)at[2]);
    }
    job->query_count = count;
    return PM_OK;
}

static pm_status build(pm_job *job)
{
    double start = pm_cpu_seconds_now();
    PM_TRY(pm_balance_build(&job->map));
    job->build_s = pm_cpu_seconds_now() - start;
    return PM_OK;
}

static int height_of(uint32_t count)
{
    int height = 0;
    while (count >> (height + 1) > 0) {
        height++;
    }
    return height;
}

static pm_status report(const pm_job *job)
{
    uint32_t count = job->map.count;
    double rate = job->query_s > 0.0 ? job->query_count / job->query_s : 0.0;
    if (!job->options->json) {
        printf("%-34s %14u\n", "photons", count);
        printf("%-34s %14d\n", "height of the tree", height_of(count));
        printf("%-34s %14.3f\n", "seconds to build it (CPU)", job->build_s);
        printf("%-34s %14.1f\n", "photons looked at in a search", job->visited);
        printf("%-34s %14.1f\n", "the same in a tree not balanced", job->visited_unbalanced);
        printf("%-34s %14.0f\n", "searches a second (one thread)", rate);
    }
    json_t *object =
        json_pack("{s:I,s:i,s:f,s:f,s:f,s:f}", "photons", (json_int_t)count, "height",
                  height_of(count), "build_s", job->build_s, "visited_mean", job->visited,
                  "visited_mean_unbalanced", job->visited_unbalanced, "queries_per_s", rate);
    object = pm_report_add(object, "notes", pm_report_notes(&job->world.scene));
    return pm_report_end(job->options, object);
}

static pm_status write_map(const pm_job *job)
{
    const pm_scene *scene = &job->world.scene;
    pm_photon_file_info info = {job->options->seed, scene->hash, scene->center};
    return pm_photon_file_write(job->options->output, &job->map, &info, NULL);
}

static pm_status trace(pm_job *job)
{
    pm_projections aim;
    PM_TRY(pm_map_aim(job->options, &job->world.scene, PM_MAP_GLOBAL, &aim));
    pm_pass_settings settings = pm_map_settings(job->options, PM_MAP_GLOBAL, 0);
    settings.projections = pm_projection_of(&aim);
    pm_status status =
        pm_photon_pass(&job->world.rays, PM_MAP_GLOBAL, &settings, &job->map, NULL);
    pm_projection_free(&aim);
    return status;
}

static pm_status begin_tables(pm_job *job)
{
    const pm_options *options = job->options;
    if (options->dump != NULL) {
        PM_TRY(pm_file_begin(options->dump, &job->dump));
        fputs(PM_TREE_DUMP_HEADER, job->dump.stream);
    }
    if (options->visits != NULL) {
        PM_TRY(pm_file_begin(options->visits, &job->visits));
        fputs(PM_VISIT_DUMP_HEADER, job->visits.stream);
    }
    return PM_OK;
}

/// The tables and the map: all were made before the first is there.
static pm_status write_files(pm_job *job)
{
    const pm_options *options = job->options;
    if (options->output != NULL) {
        PM_TRY(write_map(job));
    }
    if (options->dump != NULL) {
        PM_TRY(pm_file_commit(&job->dump));
    }
    return options->visits != NULL ? pm_file_commit(&job->visits) : PM_OK;
}

static pm_status run(pm_job *job)
{
    PM_TRY(pm_world_open(job->options, false, &job->world));
    PM_TRY(begin_tables(job));
    PM_TRY(trace(job));
    if (job->map.count > 0) {
        PM_TRY(choose_queries(job));
        PM_TRY(use_grown(job)); // first: balancing moves the photons
    }
    PM_TRY(build(job));
    if (job->map.count > 0) {
        PM_TRY(use_balanced(job));
    }
    PM_TRY(write_files(job));
    return report(job);
}

static pm_status check_options(const pm_options *options)
{
    if (options->visits != NULL && !options->has_at) {
        return pm_status_fail(
            PM_EINPUT, "%s",
            "balancing: --visits needs --at X,Y,Z, the point to search around");
    }
    if (options->has_at && options->visits == NULL) {
        return pm_status_fail(PM_EINPUT, "%s",
                              "balancing: --at is for --visits FILE.csv, which is not given");
    }
    return PM_OK;
}

int main(int argc, char **argv)
{
    pm_options options;
    int code;
    if (!pm_program_start(argc, argv, &program, &options, &code)) {
        return code;
    }
    pm_job job = {.options = &options};
    pm_status status = check_options(&options);
    if (status == PM_OK) {
        status = run(&job);
    }
    pm_file_abandon(&job.dump);
    pm_file_abandon(&job.visits);
    free(job.queries);
    pm_photon_map_free(&job.map);
    pm_world_close(&job.world);
    return pm_program_end(status);
}
