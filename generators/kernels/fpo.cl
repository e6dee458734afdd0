/* Farthest-point optimisation (Schlömer, Heck & Deussen 2011) on a periodic Delaunay triangulation.
 *
 * One work-item moves at most `budget` points of one set, in order from state.x on: point p leaves the
 * triangulation, the farthest point f of the rest is the centre of the largest circumcircle (with the local
 * strategy the largest of those through a former neighbour of p), and p goes to f
 * if r(f) exceeds p's own distance to its nearest neighbour, else stays.
 *
 * Removal clips ears off the hole left by p in order of |power of p| = incircle(a, b, c, p) / orient(a, b, c)
 * (Devillers 2002); insertion replaces the triangles whose circles hold f by a fan around f (Bowyer 1981;
 * Watson 1981). A tournament tree over the squared circumradii has the largest at its root.
 *
 * Half-edge h belongs to triangle h >> 2 (h & 3 = 0, 1, 2, counter-clockwise): origin[h] is the vertex it
 * leaves, twin[h] the same edge from the other side; leaving[v] is any half-edge that leaves v. A set of n
 * points has 2n triangles; between removal and insertion two of them are spare. Every coordinate is taken
 * relative to a vertex or centre less than 1/2 away, which holds while every circumradius is below WIDEST =
 * 1/4 (-D). EQUAL (-D) is the relative gain in squared distance below which a point stays.
 *
 * state[set] is (next point, status, points moved so far, whether the strategy is local). Nothing is repaired
 * here: a hole that is no disc, a fan that is not counter-clockwise or a circle that is too wide ends the work
 * with status 1 before the point is moved, and the host takes over there with a fresh triangulation.
 * Triangles and circles are those of fpo_circles.cl.
 */

#define RIM 48          /* most neighbours of one point; the mean is 6 */

void set_radius(__global double *tree, int leaves, int triangle, double value)
{
    int i = leaves + triangle;
    tree[i] = value;
    for (i >>= 1; i > 0; i >>= 1) {
        double larger = fmax(tree[2 * i], tree[2 * i + 1]);
        if (tree[i] == larger) break;
        tree[i] = larger;
    }
}

int largest(__global const double *tree, int leaves)
{
    int i = 1;
    while (i < leaves) i = 2 * i + (tree[2 * i] < tree[2 * i + 1]);
    return i - leaves;
}

__kernel void fpo(const int sets, const int n, const int leaves, const int budget,
                  __global double2 *all_points, __global int *all_origin, __global int *all_twin,
                  __global int *all_leaving, __global double2 *all_centre, __global double *all_tree,
                  __global int *all_mark, __global int4 *state, __global double *nearest)
{
    const int set = get_global_id(0);
    if (set >= sets || state[set].x >= n) return;
    const size_t at = (size_t)set * n;
    __global double2 *points = all_points + at, *centre = all_centre + 2 * at;
    __global int *origin = all_origin + 8 * at, *twin = all_twin + 8 * at;
    __global int *leaving = all_leaving + at, *mark = all_mark + 2 * at;
    __global double *tree = all_tree + (size_t)set * 2 * leaves;

    int rim[RIM], outer[RIM], slot[RIM + 2], neighbour[RIM];
    double2 q[RIM];
    double power[RIM];

    int moved = state[set].z;
    const int local_strategy = state[set].w;
    const int first = state[set].x, last = min(n, first + budget);
    for (int v = first; v < last; v++) {
        const double2 p = points[v];
        state[set] = (int4)(v, 1, moved, local_strategy);    /* stands if the work ends inside this move */

        /* The hole: neighbours of v counter-clockwise, relative to p. */
        int k = 0, h = leaving[v];
        double own = 1.0;
        const int start = h;
        do {
            int far_edge = next_edge(h);
            if (k == RIM) return;
            neighbour[k] = rim[k] = origin[far_edge];
            outer[k] = twin[far_edge];
            slot[k] = h >> 2;
            q[k] = shortest(points[rim[k]] - p);
            own = fmin(own, dot(q[k], q[k]));
            h = twin[next_edge(far_edge)];
            k++;
        } while (h != start);
        const int free0 = slot[k - 1], free1 = slot[k - 2], neighbours = k;
        set_radius(tree, leaves, free0, -1.0);
        set_radius(tree, leaves, free1, -1.0);

        for (int i = 0; i < k; i++)
            power[i] = ear_power(q[i ? i - 1 : k - 1], q[i], q[i + 1 < k ? i + 1 : 0]);
        int seed = 0;
        for (int m = k; m >= 3; m--) {
            int i = 1;
            if (m > 3) {
                i = 0;
                for (int j = 1; j < m; j++)
                    if (power[j] < power[i]) i = j;
            }
            const int a = i ? i - 1 : m - 1, c = i + 1 < m ? i + 1 : 0;
            if (cross2(q[i] - q[a], q[c] - q[a]) <= 0.0) return;
            const double2 to_centre = circumcentre(q[i] - q[a], q[c] - q[a]);
            const double r2 = dot(to_centre, to_centre);
            if (!(r2 < WIDEST * WIDEST)) return;

            seed = slot[m - 3];
            const int e = 4 * seed;
            origin[e] = rim[a];
            origin[e + 1] = rim[i];
            origin[e + 2] = rim[c];
            leaving[rim[a]] = e;
            leaving[rim[i]] = e + 1;
            leaving[rim[c]] = e + 2;
            twin[e] = outer[a];
            twin[outer[a]] = e;
            twin[e + 1] = outer[i];
            twin[outer[i]] = e + 1;
            if (m == 3) {
                twin[e + 2] = outer[c];
                twin[outer[c]] = e + 2;
            }
            centre[seed] = onto_torus(p + q[a] + to_centre);
            set_radius(tree, leaves, seed, r2);

            outer[a] = e + 2;
            for (int j = i; j + 1 < m; j++) {
                rim[j] = rim[j + 1];
                outer[j] = outer[j + 1];
                q[j] = q[j + 1];
                power[j] = power[j + 1];
            }
            if (m > 4) {
                const int left = i ? i - 1 : m - 2, right = i < m - 1 ? i : 0;
                for (int side = 0; side < 2; side++) {
                    const int j = side ? right : left;
                    power[j] = ear_power(q[j ? j - 1 : m - 2], q[j], q[j + 2 < m ? j + 1 : 0]);
                }
            }
        }

        double2 f = p;
        int widest = 0;
        if (local_strategy) {
            widest = seed;
            for (int i = 0; i < neighbours; i++) {
                const int out = leaving[neighbour[i]];
                h = out;
                for (int turns = 0; turns < RIM; turns++) {
                    if (tree[leaves + (h >> 2)] > tree[leaves + widest]) widest = h >> 2;
                    h = next_edge(twin[h]);
                    if (h == out) break;
                }
            }
        } else widest = largest(tree, leaves);
        if (tree[leaves + widest] > own * (1.0 + EQUAL)) {
            seed = widest;
            f = centre[seed];
            moved++;
        }

        /* The cavity of f: the connected triangles whose circles hold f, from one that surely does. */
        int size = 1;
        slot[0] = seed;
        mark[seed] = 1;
        for (int i = 0; i < size; i++)
            for (int side = 0; side < 3; side++) {
                const int other = twin[4 * slot[i] + side] >> 2;
                if (mark[other]) continue;
                const double2 u = shortest(f - centre[other]);
                if (dot(u, u) < tree[leaves + other]) {
                    if (size == RIM - 2) return;
                    mark[other] = 1;
                    slot[size++] = other;
                }
            }
        int edge = -1;
        for (int i = 0; edge < 0 && i < size; i++)
            for (int side = 0; side < 3; side++)
                if (!mark[twin[4 * slot[i] + side] >> 2]) edge = 4 * slot[i] + side;
        if (edge < 0) return;

        /* Its rim, counter-clockwise; a disc of `size` triangles has size + 2 corners. */
        const int corners = size + 2;
        k = 0;
        h = edge;
        do {
            if (k == corners) return;
            rim[k] = origin[h];
            outer[k] = twin[h];
            q[k] = shortest(points[rim[k]] - f);
            k++;
            h = next_edge(h);
            for (int turns = 0; mark[twin[h] >> 2]; turns++) {
                if (turns > 3 * size) return;
                h = next_edge(twin[h]);
            }
        } while (h != edge);
        if (k != corners) return;
        for (int i = 0; i < k; i++)
            if (cross2(q[i], q[i + 1 < k ? i + 1 : 0]) <= 0.0) return;

        slot[size] = free0;
        slot[size + 1] = free1;
        for (int i = 0; i < k; i++) {
            const int j = i + 1 < k ? i + 1 : 0, e = 4 * slot[i];
            const double2 to_centre = circumcentre(q[i], q[j]);
            const double r2 = dot(to_centre, to_centre);
            if (!(r2 < WIDEST * WIDEST)) return;
            origin[e] = v;
            origin[e + 1] = rim[i];
            origin[e + 2] = rim[j];
            twin[e + 1] = outer[i];
            twin[outer[i]] = e + 1;
            twin[e + 2] = 4 * slot[j];
            twin[4 * slot[j]] = e + 2;
            leaving[rim[i]] = e + 1;
            mark[slot[i]] = 0;
            centre[slot[i]] = onto_torus(f + to_centre);
            set_radius(tree, leaves, slot[i], r2);
        }
        leaving[v] = 4 * slot[0];
        points[v] = f;
    }

    state[set] = (int4)(last, 0, moved, local_strategy);
    if (last == n) {
        double least = 1.0;
        for (int t = 0; t < 2 * n; t++)
            for (int side = 0; side < 3; side++) {
                const int h = 4 * t + side;
                const double2 u = shortest(points[origin[h]] - points[origin[next_edge(h)]]);
                least = fmin(least, dot(u, u));
            }
        nearest[set] = sqrt(least);
    }
}
