#include "zskel/skeleton/rest_places.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace zskel;

TEST_CASE("RestPlaces: the place is found whose core a point lies deepest in") {
    RestPlaces places(0.3);
    CHECK_FALSE(places.find(Vec3(0.0f)));
    places.add(Vec3(0.0f), 1.0f);               // a core of 0.3
    places.add(Vec3(0.35f, 0.0f, 0.0f), 0.2f);  // one of 0.06
    CHECK(places.find(Vec3(0.0f, 0.29f, 0.0f)) == Vec3(0.0f));
    CHECK_FALSE(places.find(Vec3(0.0f, 0.31f, 0.0f)));
    // Nearer to the small one, but deeper in the large one's core; and the other way round.
    CHECK(places.find(Vec3(0.291f, 0.0f, 0.0f)) == Vec3(0.0f));
    CHECK(places.find(Vec3(0.2925f, 0.0f, 0.0f)) == Vec3(0.35f, 0.0f, 0.0f));
}

TEST_CASE("RestPlaces: what lies well in a core is no place of its own, what lies at its rim is") {
    RestPlaces places(0.3);
    places.add(Vec3(0.0f), 1.0f);
    places.add(Vec3(0.19f, 0.0f, 0.0f), 1.0f);
    CHECK(places.find(Vec3(0.19f, 0.0f, 0.0f)) == Vec3(0.0f));
    places.add(Vec3(0.21f, 0.0f, 0.0f), 1.0f);
    CHECK(places.find(Vec3(0.19f, 0.0f, 0.0f)) == Vec3(0.21f, 0.0f, 0.0f));
}

TEST_CASE("RestPlaces: what has no room about it is no place") {
    RestPlaces places(0.3);
    for (const float nearest : {0.0f, -1.0f, NAN, INFINITY}) places.add(Vec3(0.0f), nearest);
    CHECK_FALSE(places.find(Vec3(0.0f)));
    RestPlaces none(0.0);
    none.add(Vec3(0.0f), 1.0f);
    CHECK_FALSE(none.find(Vec3(0.0f)));
}

TEST_CASE("RestPlaces: the same as by looking at all, for cores of any size, anywhere") {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> part(-1.0f, 1.0f);
    struct Core {
        Vec3 center;
        float radius;
    };
    RestPlaces places(0.5);
    std::vector<Core> cores;  // apart, so that all are places
    const auto deepest = [&](const Vec3& point) {
        const Core* best = nullptr;
        float least = 1.0f;
        for (const Core& core : cores) {
            const float away = glm::distance(point, core.center) / core.radius;
            if (away <= least) best = &core;
            least = std::min(least, away);
        }
        return best;
    };
    for (int i = 0; i < 2000; ++i) {
        const Vec3 center(part(random), part(random), part(random));
        const float radius = std::exp2(8.0f * part(random) - 9.0f);
        const Core* inside = deepest(center);
        if (inside != nullptr && glm::distance(center, inside->center) < 0.7f * inside->radius)
            continue;
        places.add(center, 2.0f * radius);
        cores.push_back({center, radius});
    }
    std::size_t found = 0;
    for (int i = 0; i < 5000; ++i) {
        // Near one of them, so that small cores are met too.
        const Core& core = cores[random() % cores.size()];
        const Vec3 point =
            core.center + Vec3(part(random), part(random), part(random)) * core.radius;
        const Core* best = deepest(point);
        const auto place = places.find(point);
        REQUIRE(place.has_value() == (best != nullptr));
        if (best != nullptr) CHECK(*place == best->center);
        found += place ? 1 : 0;
    }
    CHECK(found > 1000);
    CHECK(found < 4900);
}
