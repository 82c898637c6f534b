#pragma once

#include <cstddef>
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

/// `raks train genre --add` without other music: adapts the same of the model of --tagger-for, or
/// of the shipped one, to the songs that a person kept, and says for how many the dance is
/// recognised at their end before and after. Returns how many songs were left out, each of which is
/// named. Errors: as learn_tagger(); a model without a tagger.
[[nodiscard]] Expected<std::size_t> adapt_to_kept(const GenreOptions& options,
                                                  const std::string& command);

}  // namespace raks::apps
