#pragma once

#include <string>

#include "apps/raks_train/genre_options.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// `raks train genre --tagger-for MODEL`: fits what the music tagger says of the model's dances to
/// the folder's music, by the way it is heard live, and writes the model with it to the output.
/// `command`: is added to how the model was made, and the clips' credits to its attribution. Says
/// how many clips are told right by a tagger that has heard none of their group. Errors: no weights
/// of the tagger; no music; a bad model.
[[nodiscard]] Expected<void> learn_tagger(const GenreOptions& options, const std::string& command);

}  // namespace raks::apps
