/* The same in C++17. */
#include <taut.hpp>

#include <cmath>
#include <vector>

int main() {
    const std::vector<double> xyz = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const std::vector<int> corners = {0, 1, 3, 1, 2, 3};
    const taut::Mesh mesh(xyz, corners);
    const std::vector<double> exact = taut::ExactSolver(mesh).field(0).distances();
    const std::vector<double> heat = taut::HeatSolver(mesh).field(0).distances();
    return std::abs(exact[2] - std::sqrt(2)) > 1e-15 || std::abs(heat[2] - std::sqrt(2)) > 0.5;
}
