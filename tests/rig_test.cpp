#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "support/extract.h"
#include "support/shapes.h"
#include "zskel/core/error.h"
#include "zskel/io/rig_glb.h"
#include "zskel/mesh/read_mesh.h"
#include "zskel/rig/skinning.h"

using namespace zskel;

namespace {

using Weights = std::vector<std::vector<Influence>>;

SkeletonGraph graph_of(const std::vector<DVec3>& positions,
                       const std::vector<SkeletonGraph::Edge>& edges, double radius = 0.1) {
    SkeletonGraph graph;
    for (const DVec3& p : positions) graph.nodes.push_back({p, radius, 0, 0.0});
    graph.edges = edges;
    return graph;
}

// Straight along x, a node every `step`.
SkeletonGraph line_graph(double from, double to, double step, double radius) {
    SkeletonGraph graph;
    for (double x = from; x < to + 0.5 * step; x += step)
        graph.nodes.push_back({{x, 0, 0}, radius, 0, 0.0});
    for (std::uint32_t n = 1; n < graph.nodes.size(); ++n) graph.edges.push_back({n - 1, n});
    return graph;
}

void check_sound(const Armature& armature) {
    for (std::size_t b = 0; b < armature.bones.size(); ++b) {
        const Bone& bone = armature.bones[b];
        if (bone.parent == kNone) {
            CHECK(bone.head == bone.tail);
        } else {
            CHECK(bone.parent < b);
            CHECK(bone.head != bone.tail);
        }
    }
    std::set<std::string> names;
    for (const Bone& bone : armature.bones) names.insert(bone.name);
    CHECK(names.size() == armature.bones.size());
    for (const auto& bones : armature.node_bones) CHECK_FALSE(bones.empty());
}

void check_sound(const Weights& weights, std::size_t bones) {
    std::size_t wrong = 0;
    for (const std::vector<Influence>& influences : weights) {
        float sum = 0.0f;
        for (const Influence& i : influences) {
            sum += i.weight;
            wrong += i.bone < bones && i.weight > 0.0f ? 0 : 1;
        }
        wrong +=
            !influences.empty() && influences.size() <= 4 && std::abs(sum - 1.0f) < 1e-5f ? 0 : 1;
    }
    CHECK(wrong == 0);
}

float weight_of(const std::vector<Influence>& influences, std::uint32_t bone) {
    for (const Influence& i : influences) {
        if (i.bone == bone) return i.weight;
    }
    return 0.0f;
}

}  // namespace

TEST_CASE("build_armature: three arms of a Y hang on its hub, off the middle of the body") {
    SkeletonGraph y = graph_of({{0, 0, 0}}, {}, 0.5);
    const std::vector<DVec3> arms = {{1, 0, 0}, {-0.6, 0.8, 0}, {-0.6, -0.8, 0}};
    for (const DVec3& arm : arms) {
        for (int i = 1; i <= 10; ++i) {
            y.nodes.push_back({arm * (0.2 * i), 0.5, 0, 0.0});
            const auto n = static_cast<std::uint32_t>(y.nodes.size() - 1);
            y.edges.push_back({i == 1 ? 0 : n - 1, n});
        }
    }
    const Armature armature = build_armature(y, {}, {});
    check_sound(armature);
    REQUIRE(armature.bones.size() == 4);
    CHECK(armature.bones[0].name == "root");
    CHECK(armature.bones[0].head == DVec3(0.0));
    CHECK(armature.cuts.empty());
    for (std::uint32_t b = 1; b < 4; ++b) {
        const Bone& bone = armature.bones[b];
        CHECK(bone.parent == 0);
        CHECK(bone.name == "branch" + std::to_string(b - 1) + ".0");
        CHECK(glm::distance(bone.head, arms[b - 1] * 0.6) < 1e-12);  // the first outside the ball
        CHECK(glm::distance(bone.tail, arms[b - 1] * 2.0) < 1e-12);
    }
    CHECK(armature.node_bones[2] == std::vector<std::uint32_t>{0});
    CHECK(armature.node_bones[3] == std::vector<std::uint32_t>{0, 1});
    CHECK(armature.node_bones[5] == std::vector<std::uint32_t>{1});
}

TEST_CASE("build_armature: a limb's bones start where its patches come away from the others'") {
    SkeletonGraph y = graph_of({{0, 0, 0}}, {}, 0.5);
    const std::vector<DVec3> arms = {{1, 0, 0}, {-0.6, 0.8, 0}, {-0.6, -0.8, 0}};
    const auto node = [](std::uint32_t arm, std::uint32_t i) { return 10 * arm + i; };
    for (std::uint32_t arm = 0; arm < 3; ++arm) {
        for (std::uint32_t i = 1; i <= 10; ++i) {
            y.nodes.push_back({arms[arm] * (0.2 * i), 0.5, 0, 0.0});
            y.edges.push_back({i == 1 ? 0 : node(arm, i - 1), node(arm, i)});
        }
    }
    // A vertex a node, and triangles between the first two arms as far as their sixth nodes; their
    // ends touch again, which tells nothing of where they start.
    for (std::uint32_t v = 0; v < y.nodes.size(); ++v) y.vertex_node.push_back(v);
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 1; i <= 5; ++i)
        triangles.emplace_back(node(0, i), node(1, i), node(1, i + 1));
    triangles.emplace_back(node(0, 10), node(1, 10), node(0, 9));
    const Armature armature = build_armature(y, triangles, {});
    check_sound(armature);
    REQUIRE(armature.bones.size() == 4);
    CHECK(glm::distance(armature.bones[1].head, y.nodes[node(0, 6)].position) < 1e-12);
    CHECK(glm::distance(armature.bones[2].head, y.nodes[node(1, 7)].position) < 1e-12);
    CHECK(glm::distance(armature.bones[3].head, y.nodes[node(2, 3)].position) < 1e-12);
    CHECK(armature.node_bones[node(1, 6)] == std::vector<std::uint32_t>{0});
}

TEST_CASE("build_armature: bones follow a bend, and are no longer than some radii") {
    SkeletonGraph bent = line_graph(0.0, 1.0, 0.05, 0.22);
    const auto corner = static_cast<std::uint32_t>(bent.nodes.size() - 1);
    for (int i = 1; i <= 20; ++i) {
        bent.nodes.push_back({{1.0, 0.05 * i, 0}, 0.22, 0, 0.0});
        const auto n = static_cast<std::uint32_t>(bent.nodes.size() - 1);
        bent.edges.push_back({n - 1, n});
    }
    bent.nodes[0].radius = 0.23;  // the root: its thickest node
    const Armature armature = build_armature(bent, {}, {});
    check_sound(armature);
    REQUIRE(armature.bones.size() == 3);
    CHECK(armature.bones[1].tail == bent.nodes[corner].position);
    CHECK(armature.bones[2].parent == 1);

    const Armature thin = build_armature(line_graph(0.0, 1.0, 0.01, 0.055), {}, {});
    check_sound(thin);
    CHECK(thin.bones.size() == 5);
    for (const Bone& bone : thin.bones) CHECK(glm::distance(bone.head, bone.tail) <= 0.29);
}

TEST_CASE("build_armature: a ring is opened opposite its root, and that is said") {
    std::vector<DVec3> places;
    std::vector<SkeletonGraph::Edge> edges;
    for (std::uint32_t i = 0; i < 9; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / 9.0;
        places.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        if (i > 0) edges.push_back({i - 1, i});
    }
    edges.push_back({0, 8});
    const Armature armature = build_armature(graph_of(places, edges), {}, {});
    check_sound(armature);
    REQUIRE(armature.cuts.size() == 1);
    CHECK(armature.cuts[0].position.x < -0.9);
    CHECK(armature.cuts[0].bone != armature.cuts[0].other);
}

TEST_CASE("build_armature: every branch beside a cut loop has bones of its own") {
    // A ring of 16 nodes, a tail of 6 at opposite ones.
    SkeletonGraph ring;
    for (std::uint32_t i = 0; i < 16; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / 16.0;
        ring.nodes.push_back({{std::cos(angle), std::sin(angle), 0.0}, 0.1, 0, 0.0});
        if (i > 0) ring.edges.push_back({i - 1, i});
    }
    ring.edges.push_back({0, 15});
    for (const std::uint32_t start : {0u, 8u}) {
        for (int i = 1; i <= 6; ++i) {
            const double side = start == 0 ? 1.0 : -1.0;
            ring.nodes.push_back({{side * (1.0 + 0.2 * i), 0.0, 0.0}, 0.1, 0, 0.0});
            const auto n = static_cast<std::uint32_t>(ring.nodes.size() - 1);
            ring.edges.push_back({i == 1 ? start : n - 1, n});
        }
    }
    const Armature armature = build_armature(ring, {}, {});
    check_sound(armature);
    CHECK(armature.cuts.size() == 1);
    const std::vector<Branch> branches = find_branches(ring);
    REQUIRE(branches.size() == 4);
    for (std::uint32_t b = 0; b < branches.size(); ++b) {
        std::size_t bones = 0;
        for (std::uint32_t bone = 0; bone < armature.bones.size(); ++bone) {
            if (armature.bones[bone].branch != b) continue;
            ++bones;
            for (std::uint32_t n = 0; n < ring.nodes.size(); ++n) {
                if (armature.node_bones[n] != std::vector<std::uint32_t>{bone}) continue;
                const auto& nodes = branches[b].nodes;
                CHECK(std::find(nodes.begin(), nodes.end(), n) != nodes.end());
            }
        }
        INFO("branch " << b);
        CHECK(bones > 0);
    }
}

TEST_CASE("build_armature: what has no junction is one chain from an end, however thick within") {
    SkeletonGraph spindle = line_graph(-1.0, 1.0, 0.1, 0.1);
    spindle.nodes[10].radius = 0.3;
    const Armature armature = build_armature(spindle, {}, {});
    check_sound(armature);
    for (std::uint32_t b = 1; b < armature.bones.size(); ++b)
        CHECK(armature.bones[b].parent == b - 1);
}

TEST_CASE("build_armature: within a bound bones get coarser, then short branches go along") {
    SkeletonGraph star = line_graph(-1.0, 1.0, 0.1, 0.05);
    for (int i = 1; i <= 3; ++i) {  // a short branch from its middle
        star.nodes.push_back({{0.0, 0.1 * i, 0}, 0.05, 0, 0.0});
        const auto n = static_cast<std::uint32_t>(star.nodes.size() - 1);
        star.edges.push_back({i == 1 ? 10u : n - 1, n});
    }
    ArmatureOptions options;
    CHECK(build_armature(star, {}, options).bones.size() > 6);
    options.max_bones = 7;  // a hub, and three times a bone and its end
    const Armature four = build_armature(star, {}, options);
    check_sound(four);
    CHECK(four.bones.size() == 4);
    CHECK(four.dropped_branches == 0);
    options.max_bones = 6;
    const Armature three = build_armature(star, {}, options);
    check_sound(three);
    CHECK(three.bones.size() == 3);
    CHECK(three.dropped_branches == 1);
    CHECK(three.node_bones.back() == std::vector<std::uint32_t>{0});  // along with the hub
    options.max_bones = 1;
    CHECK(build_armature(star, {}, options).bones.size() == 1);

    const SkeletonGraph parts = graph_of({{0, 0, 0}, {5, 0, 0}, {9, 0, 0}}, {});
    options.max_bones = 2;
    CHECK_THROWS_AS(build_armature(parts, {}, options), UsageError);
    options.max_bones = 3;
    const Armature lone = build_armature(parts, {}, options);
    check_sound(lone);
    CHECK(lone.bones.size() == 3);
    CHECK(lone.bones[2].name == "root2");
}

TEST_CASE("skin_weights: one bone fades into the next along a tube") {
    Mesh tube = test::cylinder(0.1, 1.0, 24, 41);
    for (DVec3& p : tube.positions) p = {p.z, p.y, -p.x};  // its axis along x
    SkeletonGraph axis = line_graph(-0.5, 0.5, 0.05, 0.1);
    for (const DVec3& p : tube.positions)
        axis.vertex_node.push_back(static_cast<std::uint32_t>(std::lround((p.x + 0.5) / 0.05)));
    const Armature armature = build_armature(axis, {}, {.longest_radii = 6.0});
    REQUIRE(armature.bones.size() == 3);  // the hub at the left end, and two
    const Weights weights = skin_weights(tube, axis, armature, {});
    check_sound(weights, 3);
    const double middle = armature.bones[1].tail.x;
    for (std::size_t v = 0; v < weights.size(); ++v) {
        const double off = (tube.positions[v].x - middle) / 0.1;
        const float weight = 1.0f - weight_of(weights[v], 2);
        // The closed form on a straight tube: exp(-|x| / (smoothing r)) / 2 on the far side.
        const double far = 0.5 * std::exp(-std::abs(off) / 0.5);
        if (std::abs(tube.positions[v].x) > 0.4) continue;  // the caps
        CHECK(static_cast<double>(weight) == doctest::Approx(off < 0 ? 1 - far : far).epsilon(0.1));
    }
}

TEST_CASE("skin_weights: parts that nearly touch do not share, and no vertex is left out") {
    Mesh two = test::together(test::sphere(0.5), test::moved(test::sphere(0.5), {1.001, 0, 0}));
    two.positions.emplace_back(5, 0, 0);  // no face
    SkeletonGraph graph = graph_of({{0, 0, 0}, {1.001, 0, 0}}, {}, 0.5);
    for (const DVec3& p : two.positions) graph.vertex_node.push_back(p.x < 0.5005 ? 0 : 1);
    graph.vertex_node.back() = kNone;
    const Armature armature = build_armature(graph, {}, {});
    const Weights weights = skin_weights(two, graph, armature, {});
    check_sound(weights, 2);
    for (std::size_t v = 0; v < weights.size(); ++v) {
        REQUIRE(weights[v].size() == 1);
        CHECK(weights[v][0].bone == (two.positions[v].x < 0.5005 ? 0 : 1));
    }
    graph.vertex_node.pop_back();
    CHECK_THROWS_AS(skin_weights(two, graph, armature, {}), InputError);
}

TEST_CASE("skin_weights: no vertex of the horse follows two limbs") {
    const Mesh horse = read_mesh(ZSKEL_MODELS "/horse.obj");
    const ExtractResult result = test::extract(horse);
    const Armature armature = build_armature(result.graph, horse.triangles, {});
    check_sound(armature);
    const Weights weights = skin_weights(horse, result.graph, armature, {});
    check_sound(weights, armature.bones.size());
    std::vector<bool> is_tip(armature.bones.size(), true);
    for (const Bone& bone : armature.bones) {
        if (bone.parent != kNone) is_tip[bone.parent] = false;
    }
    CHECK(armature.bones[0].parent == kNone);
    CHECK_FALSE(is_tip[0]);
    CHECK(std::count(is_tip.begin(), is_tip.end(), true) == 8);  // as many as the horse's ends
    const auto hangs_on = [&](std::uint32_t bone, std::uint32_t on) {
        while (bone != kNone && bone != on) bone = armature.bones[bone].parent;
        return bone == on;
    };
    std::vector<std::size_t> followers(armature.bones.size(), 0);
    std::size_t shared = 0;
    for (const std::vector<Influence>& influences : weights) {
        for (const Influence& i : influences) {
            ++followers[i.bone];
            for (const Influence& other : influences)
                shared += hangs_on(i.bone, other.bone) || hangs_on(other.bone, i.bone) ? 0 : 1;
        }
    }
    CHECK(shared == 0);
    CHECK(*std::min_element(followers.begin(), followers.end()) > 0);
}

TEST_CASE("skin_weights: the same bits whichever thread comes first") {
    const Mesh octopus = read_mesh(ZSKEL_MODELS "/octopus.obj");
    const ExtractResult result = test::extract(octopus);
    const Armature armature = build_armature(result.graph, octopus.triangles, {});
    const auto bits = [&] {
        std::vector<std::pair<std::uint32_t, float>> out;
        for (const std::vector<Influence>& of_vertex :
             skin_weights(octopus, result.graph, armature, {})) {
            for (const Influence& i : of_vertex) out.emplace_back(i.bone, i.weight);
        }
        return out;
    };
    const auto first = bits();
    for (int k = 0; k < 8; ++k) CHECK(bits() == first);
}

TEST_CASE("build_armature: limbs that hardly leave what they hang on are counted") {
    SkeletonGraph graph = line_graph(-0.5, 0.5, 0.05, 0.1);
    graph.nodes.push_back({{0.0, 0.12, 0.0}, 0.02});
    graph.edges.push_back({10, static_cast<std::uint32_t>(graph.nodes.size() - 1)});
    CHECK(build_armature(graph, {}, {}).stubs == 1);
    CHECK(build_armature(line_graph(-0.5, 0.5, 0.05, 0.1), {}, {}).stubs == 0);
}

TEST_CASE("write_rig_glb: mesh, joints and weights of a tube") {
    const Mesh tube = test::cylinder(0.1, 1.0, 12, 9);
    SkeletonGraph axis = graph_of({{0, 0, -0.4}, {0, 0, 0}, {0, 0, 0.4}}, {{0, 1}, {1, 2}}, 0.1);
    for (const DVec3& p : tube.positions)
        axis.vertex_node.push_back(p.z < -0.2 ? 0 : p.z < 0.2 ? 1 : 2);
    const Armature armature = build_armature(axis, {}, {});
    const std::string bytes =
        write_rig_glb(tube, armature, skin_weights(tube, axis, armature, {}), {}, "a test");
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 12, 4);
    const auto file = nlohmann::json::parse(bytes.substr(20, size));
    CHECK(file["meshes"].size() == 1);
    const auto& skin = file["skins"][0];
    const std::size_t joints = skin["joints"].size();
    CHECK(joints == armature.bones.size() + 1);  // and an end of the last
    CHECK(file["accessors"][skin["inverseBindMatrices"].get<std::size_t>()]["count"] == joints);
    // Down from the root every joint's node is where its inverse bind matrix says.
    const auto& binds =
        file["bufferViews"]
            [file["accessors"][skin["inverseBindMatrices"].get<std::size_t>()]["bufferView"]
                 .get<std::size_t>()];
    const std::size_t binary = 20 + size + 8 + binds["byteOffset"].get<std::size_t>();
    std::vector<DVec3> places(file["nodes"].size(), DVec3(0.0));
    for (std::size_t j = 0; j < joints; ++j) {
        const auto node = skin["joints"][j].get<std::size_t>();
        const auto& move = file["nodes"][node]["translation"];
        places[node] += DVec3(move[0].get<double>(), move[1].get<double>(), move[2].get<double>());
        if (file["nodes"][node].contains("children")) {
            for (const auto& child : file["nodes"][node]["children"])
                places[child.get<std::size_t>()] += places[node];
        }
        std::array<float, 16> bind{};
        std::memcpy(bind.data(), bytes.data() + binary + 64 * j, 64);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(static_cast<double>(bind[12 + k]) ==
                  doctest::Approx(-places[node][static_cast<int>(k)]).epsilon(1e-5));
            CHECK(bind[5 * k] == 1.0f);
        }
    }
    const auto& attributes = file["meshes"][0]["primitives"][0]["attributes"];
    for (const char* name : {"POSITION", "NORMAL", "JOINTS_0", "WEIGHTS_0"}) {
        const auto accessor = attributes[name].get<std::size_t>();
        CHECK(file["accessors"][accessor]["count"] == tube.positions.size());
    }
}

namespace {

// A glTF binary, and where its joints' matrices take a point at the key of an animation.
class PosedGlb {
  public:
    PosedGlb(const std::string& bytes, std::size_t key) : bytes_(bytes) {
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data() + 12, 4);
        file_ = nlohmann::json::parse(bytes.substr(20, size));
        binary_ = 20 + size + 8;
        for (const auto& node : file_["nodes"]) {
            Pose pose;
            if (node.contains("translation")) pose.place = vector(node["translation"]);
            if (node.contains("rotation")) pose.turn = quaternion(node["rotation"]);
            poses_.push_back(pose);
        }
        const auto& animation = file_["animations"][0];
        for (const auto& channel : animation["channels"]) {
            Pose& pose = poses_[channel["target"]["node"].get<std::size_t>()];
            const std::string path = channel["target"]["path"];
            const auto& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
            const int width = path == "rotation" ? 4 : 3;
            const std::vector<double> v = floats(sampler["output"], key * width, width);
            if (path == "rotation") {
                pose.turn = glm::dquat(v[3], v[0], v[1], v[2]);
            } else {
                (path == "scale" ? pose.scale : pose.place) = {v[0], v[1], v[2]};
            }
        }
        globals_.resize(poses_.size());
        for (const auto& node : file_["scenes"][0]["nodes"]) place(node, glm::dmat4(1.0));
    }

    DVec3 placed(const std::string& joint, const DVec3& point) const {
        const auto& skin = file_["skins"][0];
        for (std::size_t j = 0; j < skin["joints"].size(); ++j) {
            const auto node = skin["joints"][j].get<std::size_t>();
            if (file_["nodes"][node]["name"] != joint) continue;
            const std::vector<double> m = floats(skin["inverseBindMatrices"], 16 * j, 16);
            glm::dmat4 bind;
            for (int k = 0; k < 16; ++k) bind[k / 4][k % 4] = m[static_cast<std::size_t>(k)];
            return DVec3(globals_[node] * bind * glm::dvec4(point, 1.0));
        }
        FAIL("no joint of this name: ", joint);
        return {};
    }
    // Where the armature stands, which the file's numbers are counted from.
    DVec3 base() const { return poses_[1].place; }
    double seconds(std::size_t key) const {
        return floats(file_["animations"][0]["samplers"][0]["input"], key, 1)[0];
    }

  private:
    struct Pose {
        DVec3 place{0.0};
        glm::dquat turn{1, 0, 0, 0};
        DVec3 scale{1.0};
    };
    static DVec3 vector(const nlohmann::json& v) {
        return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
    }
    static glm::dquat quaternion(const nlohmann::json& v) {
        return {v[3].get<double>(), v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
    }
    std::vector<double> floats(const nlohmann::json& accessor, std::size_t first,
                               std::size_t count) const {
        const auto& view =
            file_["bufferViews"]
                 [file_["accessors"][accessor.get<std::size_t>()]["bufferView"].get<std::size_t>()];
        std::vector<float> values(count);
        std::memcpy(values.data(),
                    bytes_.data() + binary_ + view["byteOffset"].get<std::size_t>() + 4 * first,
                    4 * count);
        return {values.begin(), values.end()};
    }
    void place(const nlohmann::json& number, const glm::dmat4& parent) {
        const auto n = number.get<std::size_t>();
        const Pose& pose = poses_[n];
        globals_[n] =
            glm::scale(glm::translate(parent, pose.place) * glm::mat4_cast(pose.turn), pose.scale);
        if (!file_["nodes"][n].contains("children")) return;
        for (const auto& child : file_["nodes"][n]["children"]) place(child, globals_[n]);
    }

    std::string bytes_;
    nlohmann::json file_;
    std::size_t binary_ = 0;
    std::vector<Pose> poses_;
    std::vector<glm::dmat4> globals_;
};

}  // namespace

TEST_CASE("write_rig_glb: an animation takes joints where deform takes their bones") {
    Armature armature;
    armature.bones = {{"root", kNone, kNone, {1, 1, 0}, {1, 1, 0}, 0.1},
                      {"branch0.0", 0, 0, {1.2, 1, 0}, {2, 1.5, 0}, 0.1},
                      {"branch0.1", 1, 0, {2, 1.5, 0}, {2.5, 2, 0.5}, 0.1},
                      {"branch1.0", 0, 1, {1, 0.8, 0}, {1, 0, 0}, 0.1}};
    Mesh mesh;
    mesh.positions = {{1.3, 1.1, 0.2}, {2.2, 1.6, -0.1}, {1.1, 0.2, 0.1}};
    mesh.triangles = {{0, 1, 2}};
    DVec3 base(0.0);
    SUBCASE("near the origin") {}
    SUBCASE("far from it, where its own middle is the base") {
        const DVec3 away(1e6, -3e5, 2e4);
        for (DVec3& p : mesh.positions) p += away;
        for (Bone& bone : armature.bones) {
            bone.head += away;
            bone.tail += away;
        }
        base = away + DVec3(1.65, 0.9, 0.05);
    }
    Pose pose(3);
    pose[0].bones = {1, 2};
    pose[0].axis = {0, 0, 1};
    pose[0].bend = 1.2;
    pose[0].stretch = 1.5;
    pose[1].bones = {2};
    pose[1].twist = 0.7;
    pose[1].end = 2.0;
    pose[2].bones = {0};
    pose[2].axis = {1, 0, 0};
    pose[2].turn = 0.4;
    std::vector<RigKey> keys;
    for (const double seconds : {0.0, 0.6, 2.0})
        keys.push_back({seconds, bone_motions(armature, pose_at(pose, seconds))});
    const Weights weights = {{{1, 1.0f}}, {{2, 1.0f}}, {{3, 1.0f}}};
    const std::string bytes = write_rig_glb(mesh, armature, weights, keys, "a test");
    const std::array<const char*, 3> joints = {"branch0.0_stretch", "branch0.1_stretch",
                                               "branch1.0"};
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const PosedGlb posed(bytes, k);
        CHECK(glm::distance(posed.base(), base) < 0.1);
        CHECK(posed.seconds(k) == doctest::Approx(keys[k].seconds));
        const auto there =
            deform(mesh, armature, weights, keys[k].motions, Skinning::DualQuaternion);
        for (std::size_t v = 0; v < 3; ++v)
            CHECK(glm::distance(posed.placed(joints[v], mesh.positions[v] - posed.base()),
                                there[v]) < 1e-5);
        // What ends the second bone.
        Mesh end;
        end.positions = {armature.bones[2].tail};
        const auto tail =
            deform(end, armature, {{{2, 1.0f}}}, keys[k].motions, Skinning::Linear).front();
        CHECK(glm::distance(posed.placed("branch0.1_end", end.positions[0] - posed.base()), tail) <
              1e-5);
    }
}
