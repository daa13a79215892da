// The search for lines in one pixel: nodes of the hierarchy are looked at until one is found that holds an item, which is asked then,
// once in each iteration, until it has answered for all of the pixel.
//
// The kernel brings CORE_WORK_LIMIT, the most iterations, and defines after lines/search_state.glsl, each kind of surface its own,
//
//     core_surface        what the pixel shows of the surface
//     core_reaches        whether a node may hold anything that is seen in the pixel
//     core_select_item    selects the item of a leaf, unless it is known to lie elsewhere
//     core_ask            asks the item; most of the work

void core_next_item(core_surface surface, inout core_line_search search) {
    while (search.item == CORE_NO_ITEM && search.stack_size > 0u) {
        search.stack_size -= 1u;
        const core_node node = core_fetch_node(core_stack[search.stack_size]);
        const bool reaches = core_reaches(surface, node);
        if (reaches && !node.is_leaf) {
            core_stack[search.stack_size] = node.child + 1u;
            core_stack[search.stack_size + 1u] = node.child;
            search.stack_size += 2u;
        }
        if (reaches && node.is_leaf) {
            core_select_item(surface, node.child, search);
        }
        if (search.item != CORE_NO_ITEM || search.stack_size == 0u) {
            break;
        }
    }
}

void core_search_lines(core_surface surface, inout core_line_search search) {
    while (core_is_unfinished(search) && search.work < CORE_WORK_LIMIT) {
        search.work += 1u;
        core_next_item(surface, search);
        core_ask(surface, search);
        if (!core_is_unfinished(search)) {
            break;
        }
    }
}
