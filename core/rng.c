// A draw takes two of the four words of a Philox block; a new block is made when they run out.
#include "rng.h"

#include <Random123/philox.h>

pm_rng pm_rng_at(const pm_rng_source *source, uint64_t index, uint32_t bounce)
{
    return (pm_rng){
        .key = {source->seed, (uint32_t)source->stream << 28 | (source->pass & 0x0fffffffu)},
        .counter = {(uint32_t)index, (uint32_t)(index >> 32), bounce, 0},
        .used = 4,
    };
}

static void next_block(pm_rng *rng)
{
    philox4x32_ctr_t counter = {
        {rng->counter[0], rng->counter[1], rng->counter[2], rng->counter[3]}};
    philox4x32_key_t key = {{rng->key[0], rng->key[1]}};
    philox4x32_ctr_t block = philox4x32(counter, key);
    for (int i = 0; i < 4; i++) {
        rng->words[i] = block.v[i];
    }
    rng->counter[3]++;
    rng->used = 0;
}

double pm_rng_draw(pm_rng *rng)
{
    if (rng->used == 4) {
        next_block(rng);
    }
    uint64_t high = rng->words[rng->used];
    uint64_t low = rng->words[rng->used + 1];
    rng->used += 2;
    return (double)(high << 21 | low >> 11) * 0x1p-53;
}
