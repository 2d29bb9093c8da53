// Lights take turns in a dump. Every second path of a file, say, may so be from one of two
// lights; at uneven steps no light, and no lobe, is preferred.
#include "path_pick.h"

/// A fraction in [0, 1) that looks random, the same on every machine.
/// @source Steele, Lea and Flood, "Fast Splittable Pseudorandom Number Generators", 2014
static double scatter(uint64_t n)
{
    uint64_t z = (n + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

uint64_t pm_path_pick(uint64_t count, uint64_t picked, uint64_t which)
{
    // The parts' bounds are whole numbers, so no path stands in two of them.
    double step = (double)count / (double)picked;
    uint64_t begin = (uint64_t)((double)which * step);
    uint64_t end = which + 1 < picked ? (uint64_t)((double)(which + 1) * step) : count;
    uint64_t room = end - begin;
    uint64_t at = (uint64_t)(scatter(which) * (double)room);
    return begin + (at < room ? at : room - 1);
}
