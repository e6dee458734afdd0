/* Triangles of a periodic triangulation and their circles, in double.
 *
 * Half-edge h belongs to triangle h >> 2 (h & 3 = 0, 1, 2, counter-clockwise). A place is taken relative to a
 * vertex or centre less than 1/2 away. The power of the origin to the circle through a, b and c is
 * incircle(a, b, c, 0) / orient(a, b, c) (Devillers 2002).
 */

#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define NO_EAR 1e300

int next_edge(int h) { return (h & 3) == 2 ? h - 2 : h + 1; }

double cross2(double2 a, double2 b) { return a.x * b.y - a.y * b.x; }

double2 shortest(double2 u) { return u - rint(u); }

double2 onto_torus(double2 u)
{
    u -= floor(u);
    return (double2)(u.x < 1.0 ? u.x : 0.0, u.y < 1.0 ? u.y : 0.0);
}

/* Circumcentre of (0, a, b), relative to 0. */
double2 circumcentre(double2 a, double2 b)
{
    double aa = dot(a, a), bb = dot(b, b), scale = 0.5 / cross2(a, b);
    return (double2)((b.y * aa - a.y * bb) * scale, (a.x * bb - b.x * aa) * scale);
}

/* |power| of the origin to the circle of the ear (a, b, c), or NO_EAR where b is a reflex corner. */
double ear_power(double2 a, double2 b, double2 c)
{
    double area = cross2(b - a, c - a);
    if (area <= 0.0) return NO_EAR;
    return (dot(a, a) * cross2(b, c) - dot(b, b) * cross2(a, c) + dot(c, c) * cross2(a, b)) / area;
}
