// What quadrature by samples along a ray takes of the transfer function: density, and light per length, where the field has a value.
//
// The kernel brings volume/transfer.glsl and core_step_length.

#ifndef CORE_VOLUME_OPTICS
#define CORE_VOLUME_OPTICS

// Steps in one segment at most: with all loops inside below where drivers end them.
#ifndef CORE_MOST_STEPS
#define CORE_MOST_STEPS 1024u
#endif

struct core_optics {
    elvis_real density, red, green, blue;
};

core_optics core_optics_of(core_transfer_piece piece, elvis_real value) {
    const elvis_real density = core_density_at(piece, value);
    const elvis_vec3 color = density * core_color_at(piece, value);
    return core_optics(density, color.x, color.y, color.z);
}

core_optics core_optics_at(elvis_real value) { return core_optics_of(core_fetch_piece(core_piece_index(value)), value); }

elvis_vec3 core_light_of(core_optics optics) { return elvis_vec3(optics.red, optics.green, optics.blue); }

// Steps of equal length, none longer than core_step_length, along this length of a ray.
elvis_real core_wanted_steps(elvis_real length) { return max(ceil(length / elvis_real(core_step_length)), elvis_real(1)); }

uint core_n_steps(elvis_real length) { return uint(min(core_wanted_steps(length), elvis_real(CORE_MOST_STEPS))); }

// Longer steps than were asked for: the pixel is then flagged.
bool core_has_too_few_steps(elvis_real length) { return core_wanted_steps(length) > elvis_real(CORE_MOST_STEPS); }

#endif
