// A small renderer: the soft shadow of a sphere under a square light, by exported sets and an exported mask.
//
//   gbnbench export gbn -n 16 -o sets.h --copies 8
//   gbnbench export --mask 64 -o mask.h
//   c++ -std=c++11 -O2 -I. soft_shadow.cpp -o soft_shadow
//   ./soft_shadow blue > blue.pgm ; ./soft_shadow random > random.pgm
//
// Each pixel takes all points of a set, shifted on the torus (Cranley & Patterson 1976) by a vector that it
// reads from the mask: neighbours get shifts far apart, so that what error is left has less power at low
// frequencies, which the eye sees best. On standard error stands the root mean square error against 4,096
// points a pixel.

#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

#include "mask.h"
#include "sets.h"

static_assert(SETS_D == 2, "a point of the light has two coordinates");

const int SIDE = 128;        // pixels of the picture
const int REFERENCE = 64;    // points along each side of the light, for the reference

// What a light at (u, v) of its square gives to the floor at (x, y), if the sphere does not hide it.
static double light(double x, double y, double u, double v) {
    const double lx = 0.6 * u - 0.9, ly = 0.6 * v - 0.3, height = 2.0;   // the light, and the floor at 0
    const double dx = lx - x, dy = ly - y;
    const double length2 = dx * dx + dy * dy + height * height;
    // the sphere: centre (0, 0, 0.5), radius 0.45; the distance of its centre from the ray
    const double cx = -x, cy = -y, cz = 0.5;
    const double along = (cx * dx + cy * dy + cz * height) / length2;
    const double ex = cx - along * dx, ey = cy - along * dy, ez = cz - along * height;
    const bool hidden = along > 0 && along < 1 && ex * ex + ey * ey + ez * ez < 0.45 * 0.45;
    return hidden ? 0.0 : height * height * height * height / (length2 * length2);
}

static double wrapped(double value) { return value < 1 ? value : value - 1; }

int main(int count, char **words) {
    const bool blue = count < 2 || std::strcmp(words[1], "random") != 0;
    std::mt19937 numbers(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double> picture(SIDE * SIDE);
    double squares = 0;
    for (int row = 0; row < SIDE; ++row)
        for (int column = 0; column < SIDE; ++column) {
            const double x = 3.0 * (column + 0.5) / SIDE - 1.2, y = 3.0 * (row + 0.5) / SIDE - 1.5;
            // the second coordinate reads the same mask elsewhere
            const double su = (mask_ranks[row % MASK_ROWS][column % MASK_COLUMNS] + 0.5) / MASK_PIXELS;
            const int there = (row + 23) % MASK_ROWS, across = (column + 41) % MASK_COLUMNS;
            const double sv = (mask_ranks[there][across] + 0.5) / MASK_PIXELS;
            const int set = (row / MASK_ROWS + column / MASK_COLUMNS) % SETS_COUNT;
            double sum = 0;
            for (int k = 0; k < SETS_N; ++k) {
                const float *point = sets_points[set][k];
                const double u = blue ? wrapped(point[0] + su) : uniform(numbers);
                const double v = blue ? wrapped(point[1] + sv) : uniform(numbers);
                sum += light(x, y, u, v);
            }
            picture[row * SIDE + column] = sum / SETS_N;
            double exact = 0;
            for (int i = 0; i < REFERENCE * REFERENCE; ++i)
                exact += light(x, y, (i % REFERENCE + 0.5) / REFERENCE, (i / REFERENCE + 0.5) / REFERENCE);
            const double error = sum / SETS_N - exact / (REFERENCE * REFERENCE);
            squares += error * error;
        }
    std::printf("P2\n%d %d\n255\n", SIDE, SIDE);
    for (int i = 0; i < SIDE * SIDE; ++i)
        std::printf("%d\n", static_cast<int>(255.0 * std::pow(std::fmin(picture[i], 1.0), 1 / 2.2) + 0.5));
    std::fprintf(stderr, "%.6g\n", std::sqrt(squares / (SIDE * SIDE)));
    return 0;
}
