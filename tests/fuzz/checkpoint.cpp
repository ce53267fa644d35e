#include "ga/checkpoint/checkpoint.hpp"

#include "domain/design/pipelines.hpp"
#include "domain/problem/stored.hpp"
#include "tests/fuzz/reader.hpp"

namespace {

/// A run that is stopped within its blocks, and its checkpoint.
struct Begun {
    tests::Folder folder;
    rough::DesignProblem problem;
    rough::DesignPipeline pipeline;
    std::string kept;

    static rough::DesignSetup setup() {
        const tests::Folder folder;
        return {.model = rough::completed({.grid = {32}, .loading = {3}}),
                .targets = {rough::read_target(
                    folder.write("t.csv", "pressure_MPa,stiffness_MPa_per_mm\n4e-5,0.4\n8e-5,0.6\n1.6e-4,0.8\n"))}};
    }
    Begun()
        : problem(setup()),
          pipeline(rough::design_pipeline(setup(), "sample 4 | score | islands 2 rounds=2 { repeat 2 { "
                                                   "tournament 2 | cross uniform | mutate 0.2 | score | elite "
                                                   "1 } } | until generations 2 { mutate 0.2 | score | refine "
                                                   "lm 1 | plus 3 }")) {
        ga::Checkpoints<rough::DesignProblem> keeper(folder / "run", "", false, 0);
        run(keeper, 20);
        kept = ga::opened(folder / "run");
    }
    void run(ga::Checkpoints<rough::DesignProblem>& keeper, long evaluations) const {
        ga::run(pipeline, problem, ga::Population<rough::Genome>(),
                {.threads = 1, .budget = {.evaluations = evaluations, .seconds = 2}}, {}, &keeper);
    }
};

/// Resumes from a file without writing new ones, which would be slow.
struct Resumed : ga::Checkpoints<rough::DesignProblem> {
    using Checkpoints::Checkpoints;
    bool due(double) const override { return false; }
    void write(const Taken&, const ga::Ledger<rough::DesignProblem>&, const ga::Population<rough::Genome>*) override {}
};

/// A checkpoint with changes given by the bytes: four bytes per change, two of them for the place.
std::string altered(std::string kept, std::string_view bytes) {
    for (; bytes.size() >= 4 && !kept.empty(); bytes.remove_prefix(4)) {
        const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
        const std::size_t at = (256 * byte(1) + byte(2)) % kept.size(), length = byte(3) + 1;
        switch (byte(0) % 5) {
        case 0:
            kept[at] = bytes[3];
            break;
        case 1:
            kept[at] = static_cast<char>(kept[at] ^ (1 << byte(3) % 8));
            break;
        case 2:
            kept.erase(at, length);
            break;
        case 3:
            kept.insert(at, kept.substr(at, length));
            break;
        case 4:
            kept.insert(at, length, static_cast<char>(0x81)); // lists of one list
            break;
        }
    }
    return kept;
}

} // namespace

/// The altered checkpoint gets a valid checksum; otherwise it would be refused unread.
FUZZ(checkpoint) {
    static const Begun begun;
    const std::string kept = altered(begun.kept, bytes);
    begun.folder.write("run", ga::seal_of(kept) + kept);
    std::filesystem::remove(begun.folder / "run.before");
    Resumed keeper(begun.folder / "run", "", true);
    begun.run(keeper, 200);
}
