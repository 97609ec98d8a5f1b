#include "docent/apps/laboratory/laboratory.h"

int main(int argc, char** argv) {
  return docent::apps::run(docent::apps::laboratory::docent_lab(DOCENT_VERSION), argc, argv);
}
