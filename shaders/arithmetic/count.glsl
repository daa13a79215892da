// Sums over all invocations. The kernel brings core_counts.

void core_count(uint index, uint n) {
    const uint n_in_subgroup = subgroupAdd(n);
    if (subgroupElect()) {
        atomicAdd(core_counts[index], n_in_subgroup);
    }
}

// From `first` on.
void core_count(uint first, uvec4 n) {
    const uvec4 in_subgroup = subgroupAdd(n);
    if (subgroupElect()) {
        atomicAdd(core_counts[first], in_subgroup.x);
        atomicAdd(core_counts[first + 1u], in_subgroup.y);
        atomicAdd(core_counts[first + 2u], in_subgroup.z);
        atomicAdd(core_counts[first + 3u], in_subgroup.w);
    }
}
