// Light: a lamp above the viewer's left shoulder plus a sky that is brighter than the ground. Both are linear in the
// normal, so the back of a surface has minus the term of the front, and one number interpolated over the triangle
// lights both sides; the fragment shader chooses by the side that is seen.
// It multiplies the sRGB bytes directly: without light a pixel then shows exactly its texel.
vec3 decodeOctahedral(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    return normalize(n);
}

float brightness(float lightConstant, float term, bool frontSide) {
    return clamp(lightConstant + (frontSide ? term : -term), 0.0, 1.0);
}
