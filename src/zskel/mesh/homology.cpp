#include "zskel/mesh/homology.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "zskel/core/parallel.h"
#include "zskel/mesh/loops.h"

namespace zskel {
namespace {

using Class = HandleClasses::Class;

std::vector<Class> transposed(const std::vector<Class>& matrix) {
    std::vector<Class> out(matrix.size(), Class(matrix.size(), 0));
    for (std::size_t i = 0; i < matrix.size(); ++i) {
        for (std::size_t j = 0; j < matrix.size(); ++j) out[j][i] = matrix[i][j];
    }
    return out;
}

void add(Class& sum, const Class& other, std::int64_t times) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += times * other[k];
}

std::int64_t dot(const Class& a, const Class& b) {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

}  // namespace

// Fills a HandleClasses from a system of loops.
class HandleFinder {
  public:
    HandleFinder(const Surface& surface, const LoopSystem& system, std::span<const Vec3> inner)
        : surface_(surface), system_(system) {
        out_.genus = system.loops.size() / 2;
        out_.passages_.emplace(system.loops, surface.positions);
        links_ = out_.passages_->link(inner);
    }

    bool find(double min_radius_world, std::string& why) {
        // A class is what g loops that are a basis outside link it with: 0 for what bounds inside.
        const std::vector<std::uint32_t> outside = choose_basis(transposed(links_), out_.genus);
        if (outside.size() != out_.genus) {
            why = fmt::format("{} loops of genus {} link with rank {}", links_.size(), out_.genus,
                              outside.size());
            return false;
        }
        for (const Class& row : links_) {
            Class& cls = of_loop_.emplace_back();
            for (const std::uint32_t j : outside) cls.push_back(row[j]);
        }
        if (min_radius_world > 0.0) ignore_small(min_radius_world);
        out_.edge_span_ = system_.edge_span;
        out_.sums_.push_back(out_.zero());
        for (const LoopSystem::Side& side : system_.sides) {
            Class next = out_.sums_.back();
            add(next, of_loop_[side.loop], side.sign);
            out_.sums_.push_back(std::move(next));
        }
        return true;
    }

    void sum_edges(std::span<const Vec3> inner) {
        out_.edge_sums_.resize(surface_.edges.size());
        parallel_for(surface_.edges.size(), 256, [&](std::size_t begin, std::size_t end) {
            for (std::size_t e = begin; e < end; ++e) {
                const glm::uvec2& edge = surface_.edges[e];
                out_.edge_sums_[e] = out_.passages_->hash(inner[edge.x], inner[edge.y]);
            }
        });
    }

    HandleClasses take() { return std::move(out_); }

  private:
    void ignore_small(double min_radius_world) {
        const SmallHandles small = find_small_handles(surface_, system_, links_, min_radius_world);
        out_.ignored = small.handles;
        std::vector<Class> cuts;
        for (std::size_t k = 0; k < small.loops.size(); ++k) {
            if (small.handles[k].is_cut) {
                cuts.push_back(small.loops[k]);
                continue;
            }
            Class cls(out_.genus, 0);
            for (std::size_t i = 0; i < of_loop_.size(); ++i)
                add(cls, of_loop_[i], small.loops[k][i]);
            out_.filled_.push_back(std::move(cls));
        }
        // How often a loop crosses one that bounds inside is how often it links it, pushed inside.
        out_.cuts_ = cuts.size();
        for (std::size_t i = 0; i < of_loop_.size(); ++i) {
            for (const Class& cut : cuts) of_loop_[i].push_back(dot(links_[i], cut));
        }
    }

    const Surface& surface_;
    const LoopSystem& system_;
    std::vector<Class> links_;
    std::vector<Class> of_loop_;
    HandleClasses out_;
};

void HandleClasses::add_edge(Class& sum, std::uint32_t edge, bool is_forward) const {
    if (genus == 0) return;
    const glm::uvec2 span = edge_span_[edge];
    if (span.x == span.y) return;
    add(sum, sums_[span.y], is_forward ? 1 : -1);
    add(sum, sums_[span.x], is_forward ? -1 : 1);
}

bool HandleClasses::is_cut(const Class& cls) const {
    return std::any_of(cls.begin() + static_cast<std::ptrdiff_t>(genus), cls.end(),
                       [](std::int64_t value) { return value != 0; });
}

std::uint64_t HandleClasses::segment_sum(const Vec3& from, const Vec3& to) const {
    return passages_ ? passages_->hash(from, to) : 0;
}

std::uint64_t HandleClasses::edge_sum(std::uint32_t edge, bool is_forward) const {
    if (edge_sums_.empty()) return 0;
    return is_forward ? edge_sums_[edge] : -edge_sums_[edge];
}

CycleBasis::CycleBasis(const HandleClasses& handles) : handles_(handles), basis_(handles.genus) {
    for (const HandleClasses::Class& cls : handles.filled_) basis_.extend(cls);
}

bool CycleBasis::extend(const HandleClasses::Class& cls) {
    if (is_complete() || handles_.is_cut(cls)) return false;
    Class inside(cls.begin(), cls.begin() + static_cast<std::ptrdiff_t>(handles_.genus));
    if (!basis_.extend(std::move(inside))) return false;
    ++taken_;
    return true;
}

std::optional<HandleClasses> find_handles(const Surface& surface, const std::vector<Vec3>& inner,
                                          double min_radius_world, std::string& why) {
    const std::optional<LoopSystem> system = find_loops(surface);
    if (!system) {
        why = "the surface is not closed, oriented and manifold";
        return std::nullopt;
    }
    if (system->loops.empty()) return HandleClasses{};
    HandleFinder finder(surface, *system, inner);
    if (!finder.find(min_radius_world, why)) return std::nullopt;
    finder.sum_edges(inner);
    return finder.take();
}

}  // namespace zskel
