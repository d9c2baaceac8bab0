#pragma once

#include "common/config/controller_toml.hpp"
