#include "docent/telepresence/accounts/look_alikes.h"

#include <unicode/normalizer2.h>
#include <unicode/uchar.h>
#include <unicode/unistr.h>
#include <unicode/uspoof.h>

#include <memory>

#include "docent/base/check.h"

namespace docent::telepresence {
namespace {

using Letters = icu::UnicodeString;

using Checker = std::unique_ptr<USpoofChecker, decltype(&uspoof_close)>;

const USpoofChecker* checker() {
  static const Checker opened = [] {
    UErrorCode fault = U_ZERO_ERROR;
    Checker made{uspoof_open(&fault), uspoof_close};
    DOCENT_CHECK(U_SUCCESS(fault) != 0);
    return made;
  }();
  return opened.get();
}

/// Without case, and without what cannot be seen.
Letters folded(const Letters& name) {
  UErrorCode fault = U_ZERO_ERROR;
  const icu::Normalizer2* fold = icu::Normalizer2::getNFKCCasefoldInstance(fault);
  DOCENT_CHECK(U_SUCCESS(fault) != 0);
  return fold->normalize(name, fault);
}

Letters skeleton(const Letters& name) {
  UErrorCode fault = U_ZERO_ERROR;
  Letters result;
  uspoof_getSkeletonUnicodeString(checker(), 0, name, result, &fault);
  return result;
}

/// Letters and digits alone.
Letters written(std::string_view name) {
  const Letters all = Letters::fromUTF8({name.data(), static_cast<std::int32_t>(name.size())});
  Letters result;
  for (std::int32_t i = 0; i < all.length(); i = all.moveIndex32(i, 1)) {
    const UChar32 one = all.char32At(i);
    // Signs that stand for letters stay: they are what a skeleton is for.
    if (u_isUWhiteSpace(one) == 0 && (u_isalnum(one) != 0 || u_ispunct(one) == 0)) result.append(one);
  }
  return result;
}

}  // namespace

bool looks_like(std::string_view name, std::string_view other) {
  const Letters a = written(name);
  const Letters b = written(other);
  // Both orders: a capital I looks like an l, and is an i.
  return skeleton(folded(a)) == skeleton(folded(b)) || folded(skeleton(a)) == folded(skeleton(b));
}

}  // namespace docent::telepresence
