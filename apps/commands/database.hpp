#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/database/build.hpp"
#include "domain/database/screen.hpp"

/// Genome databases from settings, for the program and Python.
namespace app {

/// The parameters of a build, without those of the database.
Bindings bindings_of(rough::BuildOptions& options);
/// All parameters of a build: genomes, batch, threads, distribution and model.
std::vector<Setting> build_settings();
/// The database of the settings. An existing file keeps its set-up if no setting of a set-up is given.
rough::GenomeStore database_from(const std::filesystem::path& file, const Settings& settings);

/// The parameters of a query: max-pressure, best, threads and model.
std::vector<Setting> query_settings();
/// The set-up of a query. Its model is that of the settings, or else that of the database.
rough::DesignSetup query_from(const Settings& settings, const rough::GenomeStore& store,
                              const std::vector<rough::Target>& targets);

} // namespace app
