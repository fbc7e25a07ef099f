// The floor in shadow and light.
@fragment
fn ground_fragment(in: Floor) -> @location(0) vec4f {
    let shade = mix(1.0, lit(in.world, 7.0, in_whole(in.clip.xy)), frame.horizon.w * 0.75);
    let hollow = mix(1.0, openness(in.clip.xy, in.depth), frame.hollows.y * 0.8);
    return floor_colour(in, shade * hollow);
}
