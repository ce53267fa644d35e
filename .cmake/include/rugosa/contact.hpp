#pragma once

#include "domain/contact.hpp"
