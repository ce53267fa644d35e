#pragma once

#include "domain/accuracy/respond_within.hpp"

#include <string>
#include <vector>

namespace app {

/// What a page about a contact shows.
struct ContactShown {
    std::string name;                ///< of the profile's file
    std::vector<std::string> notes;  ///< what was read, done and assumed, a paragraph each
    rough::Profile profile;          ///< or area, as it was pressed
    rough::Model model;              ///< complete
    const rough::Response& response; ///< the whole curve
    std::vector<std::string> files;  ///< to link, by their path from the page
};

/// The page, HTML: the curve, and pressure and gap along the profile, or the pressure on an area and its
/// spots, at up to four load steps, which are solved anew. Throws as solve_contact.
std::string contact_page(const ContactShown& shown);

} // namespace app
