// Light: a lamp above the viewer's left shoulder plus a sky that is brighter than the ground. Both are linear in the
// normal, so the back of a surface has minus the term of the front, and one number interpolated over the triangle
// lights both sides; the fragment shader chooses by the side that is seen. Skirts have the normals of the surface that they
// hang from: where those point to the viewer, it is the surface's front that is meant, whichever side of a skirt is seen.
// It multiplies the sRGB bytes directly: without light a pixel then shows exactly its texel.
vec3 decodeOctahedral(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    return normalize(n);
}

// `towards`: of the normal along the direction to the viewer.
float brightness(float lightConstant, float term, bool frontFacing, float towards) {
    return clamp(lightConstant + (frontFacing || towards > 0.0 ? term : -term), 0.0, 1.0);
}
