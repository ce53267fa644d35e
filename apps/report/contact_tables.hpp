#pragma once

#include "domain/response/model.hpp"
#include "domain/response/response.hpp"

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace app {

/// What the page of a contact curve shows beside the curve.
struct ContactTables {
    nlohmann::json values;                     ///< keys of CURVE.json
    std::map<std::string, std::string> tables; ///< CURVE-NAME.csv by NAME
};

/// Values at the last load, and pressure and gap along a profile or on a map at up to four load steps, which
/// are solved again. The model is complete. Throws as solve_contact.
ContactTables contact_tables(const rough::Profile& surface, const rough::Model& model,
                             const rough::Response& response);

/// The names of its tables.
std::vector<std::string> contact_table_names(bool is_2d);

} // namespace app
