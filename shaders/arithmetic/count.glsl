// Sums over all invocations. The kernel brings core_counts.

void core_count(uint index, uint n) {
    const uint n_in_subgroup = subgroupAdd(n);
    if (subgroupElect()) {
        atomicAdd(core_counts[index], n_in_subgroup);
    }
}
