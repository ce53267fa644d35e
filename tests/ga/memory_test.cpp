#include "ga/run/memory.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

Fingerprint print_of(std::uint64_t i) {
    return {mix(i), mix(i / 3)};
} // three share the place they look at first

} // namespace

TEST_CASE("a table finds what was put in, whatever shares its place, and nothing else") {
    Table<int> table;
    CHECK(table.find(print_of(1)) == nullptr);
    std::vector<int*> places;
    for (int i = 0; i < 3000; ++i) {
        places.push_back(&(table.at(print_of(static_cast<std::uint64_t>(i))) = i));
        table.prefetch(print_of(1));
    }
    CHECK(table.size() == 3000);
    for (int i = 0; i < 3000; ++i) {
        CHECK(table.find(print_of(static_cast<std::uint64_t>(i))) == places[static_cast<std::size_t>(i)]);
        CHECK(*places[static_cast<std::size_t>(i)] == i); // it has never moved
        CHECK(&table.at(print_of(static_cast<std::uint64_t>(i))) == places[static_cast<std::size_t>(i)]);
    }
    for (std::uint64_t i = 3000; i < 6000; ++i)
        CHECK(table.find(print_of(i)) == nullptr);
    CHECK(std::as_const(table).entry(17).value == 17);
    table.clear();
    CHECK(table.size() == 0);
    CHECK(table.find(print_of(1)) == nullptr);
}

TEST_CASE("the memory forgets by halves, and what is read of the old half turns young again") {
    Memory<double> memory(2000); // two halves of ten entries of 100 bytes
    const auto fill = [&](std::uint64_t from, std::uint64_t to) {
        for (std::uint64_t i = from; i < to; ++i)
            memory.at(print_of(i)) = static_cast<double>(i);
    };
    const auto known = [&](std::uint64_t i) {
        const auto* found = memory.find(print_of(i));
        return found && std::get<double>(*found) == static_cast<double>(i);
    };
    fill(0, 10);
    memory.forget_old(100); // full, and no more than that
    CHECK(memory.young().size() == 10);
    fill(10, 11);
    memory.forget_old(100);
    CHECK(memory.young().size() == 0);
    CHECK(memory.old().size() == 11);
    CHECK(known(3));
    CHECK(std::get<double>(memory.at(print_of(3))) == 3);
    CHECK(memory.young().size() == 1);
    CHECK(memory.size() == 12);
    fill(20, 31);
    memory.forget_old(100);
    CHECK(known(3));
    CHECK(known(25));
    CHECK(!known(4));
    CHECK(memory.find(print_of(99)) == nullptr);
    CHECK(std::holds_alternative<Pending>(memory.at(print_of(99))));
    CHECK(memory.find(print_of(99)) == nullptr); // asked for, and not known yet
    memory.at(print_of(98)) = reason("broke");
    CHECK(*std::get<Reason>(*memory.find(print_of(98))) == "broke");
}
