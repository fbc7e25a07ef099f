// The floor in plain light.
@fragment
fn draft_ground_fragment(in: Floor) -> @location(0) vec4f {
    return floor_colour(in, 1.0);
}
