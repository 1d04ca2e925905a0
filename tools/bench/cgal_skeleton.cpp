// CGAL's mean curvature flow skeletonization behind our own program's command line, so that what
// runs and scores the one runs and scores the other:
//   zskel_bench_cgal -q extract MODEL -o OUTPUT.json [wH wP]
#include <CGAL/Mean_curvature_flow_skeletonization.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Skeletonization = CGAL::Mean_curvature_flow_skeletonization<Mesh>;

namespace {

void write(const Skeletonization::Skeleton& skeleton, std::ofstream& out) {
    out.precision(9);
    out << "{\"nodes\":[";
    const char* comma = "";
    for (const auto v : CGAL::make_range(vertices(skeleton))) {
        const auto& p = skeleton[v].point;
        out << comma << '[' << p.x() << ',' << p.y() << ',' << p.z() << ']';
        comma = ",";
    }
    out << "],\"edges\":[";
    comma = "";
    for (const auto e : CGAL::make_range(edges(skeleton))) {
        out << comma << '[' << source(e, skeleton) << ',' << target(e, skeleton) << ']';
        comma = ",";
    }
    out << "]}";
}

int run(int argc, char** argv) {
    if (argc < 6) {
        std::fprintf(stderr, "usage: %s -q extract MODEL -o OUTPUT.json [wH wP]\n", argv[0]);
        return 2;
    }
    Mesh mesh;
    if (!CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[3], mesh)) return 3;
    Skeletonization flow(mesh);
    if (argc == 8) {
        flow.set_quality_speed_tradeoff(std::atof(argv[6]));
        flow.set_medially_centered_speed_tradeoff(std::atof(argv[7]));
    }
    Skeletonization::Skeleton skeleton;
    flow(skeleton);
    std::ofstream out(argv[5]);
    write(skeleton, out);
    return out.good() ? 0 : 5;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
