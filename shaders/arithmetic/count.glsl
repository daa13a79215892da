// The kernel brings core_counts.

// Of all lanes of the subgroup together.
void core_count(uint index, uint n) {
    const uint all = subgroupAdd(n);
    if (subgroupElect()) {
        atomicAdd(core_counts[index], all);
    }
}
