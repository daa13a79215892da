// What all lanes of the subgroup add to core_counts, which the kernel brings.

void core_count(uint index, uint n) {
    const uint all = subgroupAdd(n);
    if (subgroupElect()) {
        atomicAdd(core_counts[index], all);
    }
}

// From `first` on.
void core_count(uint first, uvec4 n) {
    const uvec4 all = subgroupAdd(n);
    if (subgroupElect()) {
        atomicAdd(core_counts[first], all.x);
        atomicAdd(core_counts[first + 1u], all.y);
        atomicAdd(core_counts[first + 2u], all.z);
        atomicAdd(core_counts[first + 3u], all.w);
    }
}
