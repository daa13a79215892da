void vectors(uint u, uint first) {
    uvec4 v = uvec4(1u, 2u, 3u, 4u);
    v.y += u;
    v[u] += 10u;
    v = v.wzyx + uvec4(v.xy, 0u, 1u);
    result[first + 0] = v.x + 100u * v.y + 10000u * v.z + 1000000u * v.w;
    mat3 m = mat3(1, 2, 3, 4, 5, 6, 7, 8, 9);
    m[1] = vec3(u);
    m[u][2] = 20.0;
    m[2].y -= 1.0;
    vec3 x = m * vec3(1, 10, 100);
    result[first + 1] = uint(x.x);
    result[first + 2] = uint(x.y);
    result[first + 3] = uint(x.z);
    float table[5] = float[](1.5, 2.5, 3.5, 4.5, 5.5);
    result[first + 4] = uint(table[u + 1u] + table[3]);
    uvec3 w[2] = uvec3[](uvec3(1u), uvec3(2u));
    for (int i = 0; i < 3; ++i) {
        w[1][i] += uint(i);
        w[int(u)] += w[1];
    }
    result[first + 5] = w[0].x + 100u * w[0].y + 10000u * w[0].z;
    result[first + 6] = w[1].x + 100u * w[1].y + 10000u * w[1].z;
}
