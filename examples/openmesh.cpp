// taut with OpenMesh: distances by heat from a vertex, written into a property of the mesh and with it into a PLY file, as
// `quality`, which MeshLab shows as colours.
//
//     openmesh MESH VERTEX OUT.ply
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <taut/openmesh.hpp>

#include <cstdio>
#include <string>

int main(int argc, char **argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: openmesh MESH VERTEX OUT.ply\n");
        return 2;
    }
    try {
        OpenMesh::TriMesh_ArrayKernelT<> open;
        if (!OpenMesh::IO::read_mesh(open, argv[1])) throw std::runtime_error(std::string("cannot read ") + argv[1]);
        const OpenMesh::VertexHandle source(std::stoi(argv[2]));

        OpenMesh::VPropHandleT<float> quality;
        open.add_property(quality, "quality");
        taut::HeatSolver heat(taut::make_mesh(open));
        heat.field(source).distances(open.property(quality));

        open.property(quality).set_persistent(true);
        if (!OpenMesh::IO::write_mesh(open, argv[3], OpenMesh::IO::Options::Custom))
            throw std::runtime_error(std::string("cannot write ") + argv[3]);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "openmesh: %s\n", error.what());
        return 1;
    }
}
