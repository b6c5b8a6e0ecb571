// The surface point nearest to a point in space against CGAL's AABB tree: points all over the bounding box.
#include "peers.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <random>

using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<CgalMesh>>>;

// Rounding, in shares of the bounding box.
const double TOLERANCE = 1e-14;

static bool agree(const char *name, const Peers &peers) {
    const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(peers.cgal);
    std::mt19937 random(1);
    std::vector<double> points;
    for (int i = 0; i < 3000; i++)
        points.push_back(std::uniform_real_distribution<double>(box.min(i % 3), box.max(i % 3))(random));
    const double size = std::sqrt(CGAL::squared_distance(Kernel::Point_3(box.xmin(), box.ymin(), box.zmin()),
                                                         Kernel::Point_3(box.xmax(), box.ymax(), box.zmax())));
    const std::vector<double> ours = taut::Closest(peers.mesh).points(points).distances;
    const Tree tree(faces(peers.cgal).first, faces(peers.cgal).second, peers.cgal);
    double worst = 0;
    for (std::size_t i = 0; i < ours.size(); i++) {
        const Kernel::Point_3 query(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
        worst = std::max(worst, std::abs(ours[i] - std::sqrt(tree.squared_distance(query))) / size);
    }
    std::printf("%-18s %6zu points differ by %.1e of the box\n", name, ours.size(), worst);
    return worst <= TOLERANCE;
}

int main() {
    return for_each_mesh({"elephant", "fandisk", "cow", "knot1", "triceratops", "anchor", "blobby_3cc", "mask_cone",
                          "elephant-with-holes", "lion-head"},
                         agree);
}
